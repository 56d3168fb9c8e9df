// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/time_controls.h"

#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/icons.h"
#include "app/gui/theme/plain_text.h"
#include "app/gui/theme/widgets.h"

#include <QAction>
#include <QHBoxLayout>
#include <QMenu>
#include <QToolButton>

namespace posewire::gui {

namespace {

/// "Next sample (Right)".
QString helpOf(const QAction& action) {
    const QString keys = action.shortcut().toString(QKeySequence::NativeText);
    return keys.isEmpty() ? action.toolTip() : action.toolTip() + QStringLiteral(" (%1)").arg(keys);
}

} // namespace

TimeControls::TimeControls(const Actions& actions, QWidget* parent)
    : QWidget(parent), m_actions(actions), m_row(new QHBoxLayout(this)) {
    setObjectName(QStringLiteral("timeControls"));
    m_row->setContentsMargins({});
    m_row->setSpacing(2);
    add(actions.back, "step_back");
    m_playBack = add(actions.playBack, "play_back");
    m_play = add(actions.play, "play");
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

QToolButton* TimeControls::add(QAction* action, const char* icon) {
    QToolButton* button = framedButton({}, helpOf(*action), this);
    button->setObjectName(action->objectName() + QStringLiteral("Button"));
    button->setAccessibleName(action->toolTip());
    button->setProperty("iconName", QString::fromLatin1(icon));
    button->setCheckable(action->isCheckable());
    connect(button, &QToolButton::clicked, action, &QAction::trigger);
    connect(action, &QAction::changed, button, [button, action] { button->setChecked(action->isChecked()); });
    m_row->addWidget(button);
    return button;
}

void TimeControls::restyle() {
    for (QToolButton* button : findChildren<QToolButton*>()) {
        const bool isStopping =
            (button == m_play && m_shownSpeed > 0) || (button == m_playBack && m_shownSpeed < 0);
        if (const QString icon = button->property("iconName").toString(); !icon.isEmpty()) {
            button->setIcon(themedIcon(isStopping ? QStringLiteral("pause") : icon));
        }
    }
}

void TimeControls::refresh(const model::Cursor& cursor) {
    if (cursor.speed != m_shownSpeed) {
        m_shownSpeed = cursor.speed;
        m_play->setChecked(cursor.speed > 0);
        m_playBack->setChecked(cursor.speed < 0);
        restyle();
    }
    for (const QAction* speed : m_actions.speeds->actions()) {
        if (speed->isChecked()) {
            m_speed->setText(speed->toolTip() + QStringLiteral(" ▾"));
        }
    }
}

} // namespace posewire::gui
