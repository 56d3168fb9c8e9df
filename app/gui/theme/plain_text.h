// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>
#include <QVariant>

/// Qt guesses in tooltips whether a text is HTML, and takes an & in menus and on buttons for a mnemonic.
/// Where a text is not a literal of ours, these say what it is. Labels and messages are made plain by
/// plainLabel() and MessageBox of widgets.h.
namespace posewire::gui {

/// A tooltip that shows a plain text as it is: escaped where Qt would take it for HTML, which might load
/// pictures from files.
[[nodiscard]] QString toolTipText(const QString& plain);

/// The same for models: nothing for an empty one.
[[nodiscard]] inline QVariant toolTipOf(const QString& plain) {
    return plain.isEmpty() ? QVariant() : QVariant(toolTipText(plain));
}

/// Whether toolTipText() had to escape it: what is shown is text all the same.
[[nodiscard]] bool isEscapedToolTip(const QString& toolTip);

/// An entry of a menu or the text of a button: no mnemonic, one line, at most 80 characters.
[[nodiscard]] QString menuText(const QString& plain);

} // namespace posewire::gui
