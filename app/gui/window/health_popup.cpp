// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/health_popup.h"

#include "app/gui/models/event_model.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/widgets.h"
#include "app/gui/viewport/character_health.h"
#include "app/gui/window/trouble_line.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QScreen>
#include <QVBoxLayout>

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr log::Duration kPast = std::chrono::seconds(10);
/// More would be a list: that is in the dock of events.
constexpr std::size_t kMostLines = 6;

} // namespace

HealthPopup::HealthPopup(model::SessionView& session, Commands& commands, const model::CharacterKey& key,
                         QWidget* parent)
    : QFrame(parent, Qt::Popup), m_session(session), m_commands(commands), m_key(key) {
    setAttribute(Qt::WA_DeleteOnClose);
    setObjectName(QStringLiteral("healthPopup"));
    const int space = fontMetrics().height() * 3 / 4;
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(space, space, space, space);
    column->setSpacing(space / 2);
    addTitle(*column);
    addTroubles(*column);
    addButtons(*column);
    setFixedWidth(fontMetrics().averageCharWidth() * 64);
}

QString HealthPopup::lossText(model::SessionView& session, const model::CharacterKey& key) {
    const log::Stamp now = session.cursorStamp();
    const model::StreamCounts counts = session.countsOf(key, {now - kPast, now});
    if (counts.expected() == 0) {
        return tr("No samples in the last 10 s.");
    }
    const std::uint64_t lost = counts.lost + counts.incomplete;
    return lost == 0
               ? tr("All %1 samples of the last 10 s arrived.").arg(grouped(counts.expected()))
               : tr("Lost %1 of %2 samples in the last 10 s.").arg(grouped(lost), grouped(counts.expected()));
}

void HealthPopup::addTitle(QVBoxLayout& column) {
    const CharacterHealth health = characterHealth(m_session, m_key);
    auto* title = new QLabel(QString::fromStdString(m_session.displayName(m_key)), this);
    QFont bold = title->font();
    bold.setWeight(QFont::DemiBold);
    title->setFont(bold);
    title->setTextFormat(Qt::PlainText);
    auto* words = new QLabel(healthSymbol(health.level) + QLatin1Char(' ') + health.words, this);
    QPalette colours = words->palette();
    colours.setColor(QPalette::WindowText, healthColour(health.level));
    words->setPalette(colours);
    words->setTextFormat(Qt::PlainText);
    auto* row = new QHBoxLayout;
    row->addWidget(title, 1);
    row->addWidget(words);
    column.addLayout(row);
    column.addWidget(dimText(lossText(m_session, m_key), this));
}

void HealthPopup::addTroubles(QVBoxLayout& column) {
    const auto troubles = m_session.troublesOf(m_key);
    for (std::size_t i = 0; i < std::min(kMostLines, troubles.size()); ++i) {
        const model::Event& event = *troubles[i];
        QString text = QString::fromStdString(event.text());
        if (event.type) {
            text.prepend(tr("Type %1: ").arg(event.type.value(), 2, 10, QLatin1Char('0')));
        }
        auto* line = new TroubleLine(healthOf(event.severity()), text,
                                     tr("since %1").arg(timeOfDay(event.firstStamp)), this);
        line->setToolTip(tr("Show the packets"));
        connect(line, &QAbstractButton::clicked, this,
                [this, number = event.number] { showPackets(number); });
        column.addWidget(line);
    }
    if (troubles.size() > kMostLines) {
        column.addWidget(dimText(tr("and %1 more").arg(grouped(troubles.size() - kMostLines)), this));
    }
    const model::Condition condition = m_session.conditionOf(m_key);
    if (troubles.empty()) {
        column.addWidget(dimText(condition.reason.empty() ? tr("Nothing is wrong.")
                                                          : QString::fromStdString(condition.reason),
                                 this));
    }
}

void HealthPopup::addButtons(QVBoxLayout& column) {
    auto* row = new QHBoxLayout;
    const auto add = [&](const QString& name, const QString& text, auto run) {
        auto* button = new QPushButton(text, this);
        button->setObjectName(name);
        button->setAutoDefault(true);
        connect(button, &QPushButton::clicked, this, [this, run] {
            run();
            close();
        });
        row->addWidget(button);
    };
    row->addStretch(1);
    add(QStringLiteral("frameCharacter"), tr("Show in the viewport"), [this] {
        m_commands.setCharacterVisible(m_key, true);
        m_commands.frameCharacter(m_key);
    });
    add(QStringLiteral("allEvents"), tr("All events"),
        [this] { m_commands.showDock(QStringLiteral("events")); });
    column.addLayout(row);
}

void HealthPopup::showPackets(std::uint64_t number) {
    const model::Event* event = m_session.events().find(number);
    if (event == nullptr || !showPacketsOf(m_session, m_commands, *event)) {
        m_commands.showDock(QStringLiteral("events"));
    }
    close();
}

void HealthPopup::showAbove(const QWidget& widget) {
    adjustSize();
    const QRect room = widget.screen()->availableGeometry();
    QPoint place = widget.mapToGlobal(QPoint(0, -height() - 4));
    place.setX(std::clamp(place.x(), room.left(), std::max(room.left(), room.right() - width())));
    place.setY(std::max(place.y(), room.top()));
    move(place);
    show();
    const auto buttons = findChildren<QAbstractButton*>();
    if (!buttons.isEmpty()) {
        buttons.first()->setFocus(Qt::PopupFocusReason);
    }
}

void HealthPopup::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setPen(theme().line);
    painter.setBrush(theme().panel);
    painter.drawRect(rect().adjusted(0, 0, -1, -1));
}

} // namespace posewire::gui
