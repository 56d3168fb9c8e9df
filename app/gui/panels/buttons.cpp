// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/buttons.h"

namespace posewire::gui {

QToolButton* framedButton(const QString& text, const QString& toolTip, QWidget* parent) {
    auto* button = new QToolButton(parent);
    button->setText(text);
    button->setToolTip(toolTip);
    button->setProperty("framed", true);
    return button;
}

QToolButton* flatButton(const QString& text, const QString& toolTip, QWidget* parent) {
    auto* button = new QToolButton(parent);
    button->setText(text);
    button->setToolTip(toolTip);
    button->setAccessibleName(toolTip);
    button->setProperty("flat", true);
    return button;
}

CommandBar::CommandBar(QWidget* parent) : QToolBar(parent) {
    setToolButtonStyle(Qt::ToolButtonTextOnly);
    setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Preferred);
    if (auto* more = findChild<QToolButton*>(QStringLiteral("qt_toolbar_ext_button"))) {
        // Text, since the style's icon is black in the dark theme as well.
        more->setToolButtonStyle(Qt::ToolButtonTextOnly);
        more->setText(QStringLiteral("»"));
        more->setToolTip(tr("More"));
        more->setAccessibleName(more->toolTip());
        more->setFocusPolicy(Qt::StrongFocus);
    }
}

QAction* CommandBar::addCommand(const QString& name, const QString& text, const QString& toolTip) {
    QAction* action = addAction(text);
    action->setToolTip(toolTip);
    QWidget* button = widgetForAction(action);
    button->setObjectName(name);
    button->setAccessibleName(toolTip);
    button->setProperty("framed", true);
    button->setFocusPolicy(Qt::StrongFocus);
    return action;
}

} // namespace posewire::gui
