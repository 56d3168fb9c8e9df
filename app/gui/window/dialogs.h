// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

class QTextDocument;
class QWidget;

namespace posewire::gui {

/// Gives Markdown's tables, which come with raised white borders, the look of the theme.
void styleTables(QTextDocument& document);

/// A window with text to read, in Markdown; deletes itself when closed.
void showText(const QString& title, const QString& markdown, QWidget* parent);

/// All keys of the menus, in Markdown.
[[nodiscard]] QString shortcutsText();
[[nodiscard]] QString aboutText();

} // namespace posewire::gui
