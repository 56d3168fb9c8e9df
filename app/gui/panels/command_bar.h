// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QToolBar>

namespace posewire::gui {

/// Framed buttons that give way to their neighbours: where there is no room they go into a menu.
class CommandBar final : public QToolBar {
    Q_OBJECT

public:
    explicit CommandBar(QWidget* parent = nullptr);

    /// `name` is the button's object name; it may be empty.
    QAction* addCommand(const QString& name, const QString& text, const QString& toolTip);
};

} // namespace posewire::gui
