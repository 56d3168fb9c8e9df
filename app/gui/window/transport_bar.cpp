// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/transport_bar.h"

#include "app/gui/models/receiving_models.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/theme.h"
#include "core/model/body/character_pose.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"

#include <QAction>
#include <QMenu>
#include <QStyle>
#include <QToolButton>

#include <algorithm>
#include <array>
#include <utility>

namespace posewire::gui {

namespace {

constexpr double kTimeScale = 1.3;
constexpr int kWide = 160; ///< characters; in a narrower bar buttons are without their keys

QToolButton* buttonOf(QAction* action, QWidget* parent) {
    QToolButton* button = framedButton({}, action->toolTip(), parent);
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    QObject::connect(button, &QToolButton::clicked, action, &QAction::trigger);
    return button;
}

/// Keeps room for the widest of its texts, so that another one moves nothing.
void keepRoom(QToolButton& button, const QStringList& texts) {
    int widest = 0;
    button.ensurePolished();
    for (const QString& text : texts) {
        button.setText(text);
        widest = std::max(widest, button.sizeHint().width());
    }
    button.setMinimumWidth(widest);
}

/// "Next sample (Right)".
QString helpOf(const QAction& action) {
    const QString keys = action.shortcut().toString(QKeySequence::NativeText);
    return keys.isEmpty() ? action.toolTip() : action.toolTip() + QStringLiteral(" (%1)").arg(keys);
}

} // namespace

/// Moves through the past: a sample back and on, plays either way, its speed, again and again.
class TimeControls final : public QWidget {
public:
    TimeControls(const TransportBar::Actions& actions, QWidget* parent)
        : QWidget(parent), m_speeds(actions.speeds) {
        setObjectName(QStringLiteral("timeControls"));
        add(actions.back, "step_back");
        m_playBack = add(actions.playBack, "play_back");
        add(actions.on, "step_on");
        add(actions.loop, "loop");
        m_speed = framedButton({}, tr("How fast it is played"), this);
        m_speed->setAccessibleName(tr("Speed"));
        m_speed->setMenu(actions.speeds);
        m_speed->setPopupMode(QToolButton::InstantPopup);
        m_row->addWidget(m_speed);
        new EventWatch(this, QEvent::PaletteChange, [this] { restyle(); });
        restyle();
    }

    void refresh(const model::Cursor& cursor) {
        if (cursor.speed != m_shownSpeed) {
            m_shownSpeed = cursor.speed;
            m_playBack->setChecked(cursor.speed < 0);
            restyle();
        }
        for (const QAction* speed : m_speeds->actions()) {
            if (speed->isChecked()) {
                m_speed->setText(speed->toolTip() + QStringLiteral(" ▾"));
            }
        }
    }

private:
    QToolButton* add(QAction* action, const char* icon) {
        QToolButton* button = framedButton({}, helpOf(*action), this);
        button->setObjectName(action->objectName() + QStringLiteral("Button"));
        button->setAccessibleName(action->toolTip());
        button->setProperty("iconName", QString::fromLatin1(icon));
        button->setCheckable(action->isCheckable());
        connect(button, &QToolButton::clicked, action, &QAction::trigger);
        connect(action, &QAction::changed, button,
                [button, action] { button->setChecked(action->isChecked()); });
        m_row->addWidget(button);
        return button;
    }
    void restyle() {
        for (QToolButton* button : findChildren<QToolButton*>()) {
            const bool isStopping = button == m_playBack && m_shownSpeed < 0;
            if (const QString icon = button->property("iconName").toString(); !icon.isEmpty()) {
                button->setIcon(themedIcon(isStopping ? QStringLiteral("pause") : icon));
            }
        }
    }

    QMenu* m_speeds;
    QHBoxLayout* m_row = spacedRow({}, 2, this);
    QToolButton* m_playBack;
    QToolButton* m_speed;
    double m_shownSpeed = 0;
};

TransportBar::TransportBar(model::SessionView& session, const Actions& actions, QWidget* parent)
    : QWidget(parent),
      m_session(&session),
      m_actions(actions),
      m_record(buttonOf(actions.record, this)),
      m_pause(buttonOf(actions.pause, this)),
      m_live(buttonOf(actions.live, this)),
      m_past(new TimeControls(actions, this)),
      m_add(buttonOf(actions.inputs, this)) {
    setObjectName(QStringLiteral("transport"));
    m_live->setToolButtonStyle(Qt::ToolButtonTextOnly);
    m_live->setProperty("framed", false);
    m_add->setAccessibleName(tr("Input"));
    m_time->setObjectName(QStringLiteral("transportTime"));
    m_time->setAccessibleDescription(tr("Time of day shown"));
    auto* row = spacedRow({12, 6, 12, 7}, 10, this);
    row->addWidget(m_record);
    row->addWidget(m_pause);
    row->addWidget(m_past);
    row->addWidget(m_live);
    row->addSpacing(6);
    row->addWidget(m_time);
    row->addWidget(m_detail, 1);
    m_pillLayout->setSpacing(8);
    row->addLayout(m_pillLayout);
    row->addWidget(m_add);
    paintAsBar(this);
    new EventWatch(this, QEvent::PaletteChange, [this] { restyle(); });
    new EventWatch(this, QEvent::Resize, [this] {
        const bool isWide = width() > kWide * fontMetrics().averageCharWidth();
        if (std::exchange(m_isWide, isWide) != isWide) {
            restyle();
        }
    });
    m_record->setCheckable(true);
    setFocusProxy(m_pause);
    m_record->setObjectName(QStringLiteral("recordButton"));
    m_live->setObjectName(QStringLiteral("modeButton"));
    restyle();
    showTake({});
    refresh();
}

void TransportBar::restyle() {
    m_add->setIcon(themedIcon(QStringLiteral("add")));
    m_add->setText(tr("Input"));
    m_add->setToolButtonStyle(m_isWide ? Qt::ToolButtonTextBesideIcon : Qt::ToolButtonIconOnly);
    layout()->setSpacing(m_isWide ? 10 : 6);
    QFont font = monospaceFont();
    font.setPointSizeF(font.pointSizeF() * kTimeScale);
    m_time->setFont(font);
    m_detail->setFont(tabularFont());
    m_time->setMinimumWidth(QFontMetrics(font).horizontalAdvance(QStringLiteral("00:00:00.000")));
    m_record->setIcon(themedIcon(QStringLiteral("record"), theme().error));
    showMode(Mode::Paused); // the widest
    keepRoom(*m_live, {tr("● LIVE"), tr("○ WAITING"), tr("○ NO INPUT"), fitting(tr("Go live   L"))});
    keepRoom(*m_pause, {fitting(tr("Play   Space")), fitting(tr("Pause   Space"))});
    keepRoom(*m_record,
             {tr("REC %1:%2").arg(QStringLiteral("000"), QStringLiteral("00")), fitting(tr("Record   R"))});
    showMode(modeNow());
}

/// Returns the text without its key in a narrow bar.
QString TransportBar::fitting(const QString& text) const {
    return m_isWide ? text : text.section(QStringLiteral("   "), 0, 0);
}

void TransportBar::showTake(const std::optional<TakeState>& take) {
    m_record->setChecked(take.has_value());
    const bool isDisplaced = take && !take->figures.displaced.empty();
    if (m_record->property("alarm") != isDisplaced) {
        m_record->setProperty("alarm", isDisplaced);
        m_record->style()->unpolish(m_record);
        m_record->style()->polish(m_record);
    }
    if (!take) {
        m_record->setText(fitting(tr("Record   R")));
        m_record->setToolTip(tr("Record what is received to a file (R)"));
        m_record->setAccessibleName(tr("Record"));
        return;
    }
    const auto seconds = static_cast<std::int64_t>(take->seconds);
    m_record->setText(tr("REC %1:%2").arg(seconds / 60).arg(seconds % 60, 2, 10, QLatin1Char('0')));
    const QString missed =
        take->figures.missed == 0
            ? tr("nothing missed")
            : tr("%1 packets missed: the disk is too slow").arg(grouped(take->figures.missed));
    m_record->setToolTip(toolTipText(tr("Recording to %1: %2 packets, %3 MB, %4. Press to stop (R).")
                                         .arg(take->path, grouped(take->figures.packets),
                                              grouped(take->figures.bytes / 1'000'000), missed)));
    m_record->setAccessibleName(tr("Recording, %1").arg(m_record->text()));
}

void TransportBar::showSession(model::SessionView& session, bool isLive) {
    m_session = &session;
    m_live->setVisible(isLive);
    refresh();
}

TransportBar::Mode TransportBar::modeNow() const {
    if (m_session->choices().cursor.mode == model::Cursor::Mode::Paused) {
        return m_session->choices().cursor.speed == 0 ? Mode::Paused : Mode::Playing;
    }
    const bool isAnyLive =
        std::ranges::any_of(m_session->roster().characters(), [this](const model::Character& character) {
            return isLive(*m_session, character);
        });
    return isAnyLive ? Mode::Live : m_hasInputs ? Mode::Waiting : Mode::Idle;
}

void TransportBar::showMode(Mode mode) {
    m_mode = mode;
    const bool isStopped = mode == Mode::Paused;
    m_pause->setIcon(themedIcon(isStopped ? QStringLiteral("play") : QStringLiteral("pause")));
    m_pause->setText(fitting(isStopped ? tr("Play   Space") : tr("Pause   Space")));
    m_pause->setAccessibleName(isStopped ? tr("Play") : tr("Pause"));
    const std::array texts{tr("● LIVE"), tr("○ WAITING"), tr("○ NO INPUT"), tr("Go live   L"),
                           tr("Go live   L")};
    const std::array names{tr("Live"), tr("Waiting"), tr("No input"), tr("Paused"), tr("Playing")};
    const std::array helps{tr("The display follows the stream."),
                           tr("The display follows the stream, but nothing is arriving."),
                           tr("There is nothing to listen to. Add an input (Input > Inputs)."),
                           tr("The display is paused; receiving continues. Click to follow again (L)."),
                           tr("Playing the past; receiving continues. Click to follow again (L).")};
    m_live->setText(fitting(texts[static_cast<std::size_t>(mode)]));
    m_live->setAccessibleName(names[static_cast<std::size_t>(mode)]);
    m_live->setToolTip(toolTipText(helps[static_cast<std::size_t>(mode)]));
    m_live->setProperty("live", mode == Mode::Live);
    m_live->style()->unpolish(m_live);
    m_live->style()->polish(m_live);
}

void TransportBar::followMode() {
    if (const Mode mode = modeNow(); mode != m_mode) {
        showMode(mode);
    }
}

/// Of the character that is shown; of another that still sends poses where that one does not.
const model::CharacterPose* TransportBar::timedPose() {
    const auto key = shownCharacter(*m_session);
    const model::CharacterPose* shown = key ? m_session->messages().pose(*key) : nullptr;
    const auto isNew = [this](const model::CharacterPose* pose) {
        return pose != nullptr && log::secondsOf(m_session->cursorStamp() - pose->stamp) < kStaleAge;
    };
    if (!key || isNew(shown)) {
        return shown;
    }
    for (const model::Character* other : m_session->roster().listed()) {
        if (const model::CharacterPose* pose = m_session->messages().pose(other->key); isNew(pose)) {
            return pose;
        }
    }
    return shown;
}

void TransportBar::refresh() {
    followMode();
    m_past->refresh(m_session->choices().cursor);
    const model::CharacterPose* pose = timedPose();
    if (pose == nullptr) {
        m_time->setText(m_session->now() == log::Stamp()
                            ? QStringLiteral("--:--:--.---")
                            : timeOfDay(m_session->wallOf(m_session->cursorStamp())));
        showDetail(m_session->end() == 0 ? tr("nothing received yet") : tr("no pose"));
        return;
    }
    // In the past it is the moment that is shown, as everything else in the window says it.
    const bool isPast = m_session->choices().cursor.mode == model::Cursor::Mode::Paused;
    m_time->setText(timeOfDay(m_session->wallOf(isPast ? m_session->cursorStamp() : pose->stamp)));
    const bool isPlaying = m_session->choices().cursor.speed != 0;
    const QString inTake = isPlaying ? tr("sample %1 · playing") : tr("sample %1 · paused");
    const QString live = isPlaying ? tr("sample %1 · playing · receiving goes on")
                                   : tr("sample %1 · paused · receiving goes on");
    const QString past = m_session->isRecording() ? inTake : live;
    showDetail((isPast ? past : tr("sample %1 · received")).arg(grouped(pose->sample)));
}

/// With the range that is selected, which no dock may show.
void TransportBar::showDetail(const QString& text) {
    const bool isSelected = m_session->choices().range.fixed.has_value();
    const QString selected = isSelected ? spanText(*m_session) : QString();
    m_detail->setText(selected, isSelected ? QStringLiteral(" · ") + text : text);
    m_detail->setToolTip(toolTipText(m_detail->text()));
}

void TransportBar::setReceiving(const ReceivingState& receiving) {
    std::size_t shown = 0;
    const auto show = [&](Health level, const QString& text, const QString& toolTip) {
        if (shown == m_pills.size()) {
            auto* added = new ColourText(ColourText::Look::Pill, this);
            added->setObjectName(QStringLiteral("inputPill%1").arg(m_pills.size()));
            connect(added, &QAbstractButton::clicked, this,
                    [this, place = m_pills.size()] { emit inputRequested(m_inputs[place]); });
            m_pillLayout->addWidget(added);
            m_pills.push_back(added);
        }
        ColourText* pill = m_pills[shown++];
        pill->setVisible(true);
        pill->setContent(level, text);
        pill->setToolTip(toolTipText(toolTip));
    };
    m_hasInputs = !receiving.ports.empty() || !receiving.stage.isEmpty();
    m_inputs.clear();
    for (const PortState& state : receiving.ports) {
        m_inputs.push_back(state.port);
        const PropertyValue now = inputState(state);
        show(now.health == Health::Good ? Health::Unknown : now.health, displayText(state.port), now.text);
        const bool isTrouble = now.health == Health::Warning || now.health == Health::Error;
        m_pills[shown - 1]->setVisible(m_isWide || isTrouble); // a narrow bar has no room for the others
    }
    for (std::size_t i = shown; i < m_pills.size(); ++i) {
        m_pills[i]->setVisible(false);
    }
    followMode();
}

} // namespace posewire::gui
