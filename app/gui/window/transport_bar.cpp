// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/transport_bar.h"

#include "app/gui/models/receiving_models.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/stream_state.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/icons.h"
#include "app/gui/window/colour_text.h"
#include "core/model/body/character_pose.h"

#include <QAction>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QStyle>
#include <QToolButton>

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr double kTimeScale = 1.3;

QToolButton* framedButton(QAction* action, QWidget* parent) {
    auto* button = new QToolButton(parent);
    button->setProperty("framed", true);
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    button->setToolTip(action->toolTip());
    QObject::connect(button, &QToolButton::clicked, action, &QAction::trigger);
    return button;
}

} // namespace

TransportBar::TransportBar(model::SessionView& session, const Actions& actions, QWidget* parent)
    : QWidget(parent),
      m_session(session),
      m_pause(framedButton(actions.pause, this)),
      m_live(framedButton(actions.live, this)),
      m_add(framedButton(actions.inputs, this)),
      m_relay(new ColourText(ColourText::Look::Pill, this)),
      m_time(new QLabel(this)),
      m_detail(new QLabel(this)),
      m_pillLayout(new QHBoxLayout) {
    setObjectName(QStringLiteral("transport"));
    m_live->setToolButtonStyle(Qt::ToolButtonTextOnly);
    m_live->setProperty("framed", false);
    m_add->setText(tr("Input"));
    m_time->setAccessibleName(tr("Time of day shown"));
    m_detail->setForegroundRole(QPalette::PlaceholderText);
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(12, 6, 12, 7);
    row->setSpacing(10);
    row->addWidget(m_pause);
    row->addWidget(m_live);
    row->addSpacing(6);
    row->addWidget(m_time);
    row->addWidget(m_detail, 1);
    m_pillLayout->setSpacing(8);
    row->addLayout(m_pillLayout);
    row->addWidget(m_relay);
    row->addWidget(m_add);
    m_relay->setClickable(true);
    m_relay->setVisible(false);
    connect(m_relay, &QAbstractButton::clicked, actions.relay, &QAction::trigger);
    m_detail->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    restyle();
    refresh();
}

void TransportBar::restyle() {
    m_add->setIcon(themedIcon(QStringLiteral("add")));
    QFont font = monospaceFont();
    font.setPointSizeF(font.pointSizeF() * kTimeScale);
    m_time->setFont(font);
    m_detail->setFont(tabularFont());
    m_time->setMinimumWidth(QFontMetrics(font).horizontalAdvance(QStringLiteral("00:00:00.000")));
    showMode(modeNow());
}

TransportBar::Mode TransportBar::modeNow() const {
    if (m_session.cursor().mode == model::Cursor::Mode::Paused) {
        return Mode::Paused;
    }
    const bool isAnyLive =
        std::ranges::any_of(m_session.characters(), [this](const model::Character& character) {
            return isLive(m_session, character);
        });
    return isAnyLive ? Mode::Live : Mode::Waiting;
}

void TransportBar::showMode(Mode mode) {
    m_mode = mode;
    const bool isPaused = mode == Mode::Paused;
    m_pause->setIcon(themedIcon(isPaused ? QStringLiteral("play") : QStringLiteral("pause")));
    m_pause->setText(isPaused ? tr("Go live   Space") : tr("Pause   Space"));
    m_live->setText(isPaused ? tr("▮▮ PAUSED") : mode == Mode::Live ? tr("● LIVE") : tr("○ WAITING"));
    m_live->setToolTip(isPaused
                           ? tr("The display is paused; receiving continues. Click to follow again (End).")
                       : mode == Mode::Live ? tr("The display follows the stream.")
                                            : tr("The display follows the stream, but nothing is arriving."));
    m_live->setProperty("live", mode == Mode::Live);
    m_live->style()->unpolish(m_live);
    m_live->style()->polish(m_live);
}

void TransportBar::refresh() {
    if (const Mode mode = modeNow(); mode != m_mode) {
        showMode(mode);
    }
    const auto key = shownCharacter(m_session);
    const model::CharacterPose* pose = key ? m_session.pose(*key) : nullptr;
    if (pose == nullptr) {
        m_time->setText(m_session.now() == log::Stamp() ? QStringLiteral("--:--:--.---")
                                                        : timeOfDay(m_session.cursorStamp()));
        m_detail->setText(m_session.end() == 0 ? tr("nothing received yet") : tr("no pose"));
        return;
    }
    m_time->setText(timeOfDay(pose->stamp));
    m_detail->setText(tr("received · sample %1").arg(grouped(pose->sample)));
}

void TransportBar::setReceiving(const ReceivingState& receiving) {
    const std::size_t count = receiving.ports.size() + (receiving.file.isEmpty() ? 0 : 1);
    while (m_pills.size() < count) {
        m_pills.push_back(new ColourText(ColourText::Look::Pill, this));
        m_pillLayout->addWidget(m_pills.back());
    }
    for (std::size_t i = 0; i < receiving.ports.size(); ++i) {
        const PortState& state = receiving.ports[i];
        const PropertyValue now = inputState(state);
        const bool isFine = now.health == Health::Good || now.health == Health::Unknown;
        m_pills[i]->setVisible(true);
        m_pills[i]->setContent(isFine ? Health::Unknown : now.health, displayText(state.port));
        m_pills[i]->setToolTip(now.text);
    }
    for (std::size_t i = count; i < m_pills.size(); ++i) {
        m_pills[i]->setVisible(false);
    }
    showRelays(receiving.relays);
    if (!receiving.file.isEmpty()) {
        m_pills[count - 1]->setVisible(true);
        m_pills[count - 1]->setContent(Health::Unknown, receiving.file);
        m_pills[count - 1]->setToolTip(tr("File"));
    }
}

void TransportBar::showRelays(const std::vector<RelayState>& relays) {
    QStringList lines;
    Health level = Health::Unknown;
    qsizetype wanted = 0;
    for (const RelayState& relay : relays) {
        if (relay.target.isOn) {
            ++wanted;
            const PropertyValue stage = relayStage(relay);
            const bool isWorse = stage.health == Health::Error || level == Health::Unknown;
            level = stage.health != Health::Good && isWorse ? stage.health : level;
            lines += tr("%1: %2, %3 sent").arg(displayText(relay.target), stage.text, grouped(relay.sent));
        }
    }
    m_relay->setVisible(wanted > 0);
    m_relay->setContent(level, wanted == 1 ? tr("⇉ Relay") : tr("⇉ Relay to %1").arg(wanted));
    m_relay->setToolTip(lines.join(QLatin1Char('\n')));
}

void TransportBar::changeEvent(QEvent* event) {
    if (event->type() == QEvent::PaletteChange) {
        restyle();
    }
    QWidget::changeEvent(event);
}

void TransportBar::resizeEvent(QResizeEvent* event) {
    m_detail->setVisible(width() > 50 * fontMetrics().averageCharWidth() * 2);
    QWidget::resizeEvent(event);
}

void TransportBar::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.fillRect(rect(), theme().window);
    painter.fillRect(QRect(0, height() - 1, width(), 1), theme().line);
}

} // namespace posewire::gui
