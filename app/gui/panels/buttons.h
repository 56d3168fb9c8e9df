// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QToolBar>
#include <QToolButton>

namespace posewire::gui {

/// A button with an outline. It is called by its text.
[[nodiscard]] QToolButton* framedButton(const QString& text, const QString& toolTip, QWidget* parent);

/// A button that gets its outline from the pointer. Screen readers call it by its tooltip, since its text is
/// often no more than a sign.
[[nodiscard]] QToolButton* flatButton(const QString& text, const QString& toolTip, QWidget* parent);

/// Framed buttons that give way to their neighbours: where there is no room they go into a menu.
class CommandBar final : public QToolBar {
    Q_OBJECT

public:
    explicit CommandBar(QWidget* parent = nullptr);

    /// `name` is the button's object name; it may be empty.
    QAction* addCommand(const QString& name, const QString& text, const QString& toolTip);
};

} // namespace posewire::gui
