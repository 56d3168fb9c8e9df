// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QString>

#include <initializer_list>
#include <variant>

class QDialog;
class QDialogButtonBox;
class QLayout;
class QMessageBox;
class QToolButton;
class QWidget;

/// Ways into the user guide from wherever in the window. A place is a page, "packets", or a heading on it,
/// "messages#recording-failed".
namespace posewire::gui {

/// Of the links that openHelp() follows; the window takes them through QDesktopServices, so that nobody who
/// links to the guide has to know the window.
inline constexpr const char* kHelpScheme = "posewire-help";

void openHelp(const QString& place);

void setHelpPlace(QWidget& widget, const QString& place);
/// That of the widget or of the nearest one around it; empty for none.
[[nodiscard]] QString helpPlaceOf(const QWidget* widget);

/// A small "?" that opens a place. Screen readers call it "Help on …".
[[nodiscard]] QToolButton* helpButton(const QString& about, const QString& place, QWidget* parent);

/// Gives a message a button and F1, which open a place; the message stays.
void offerHelp(QMessageBox& message, const QString& place);

/// Gives a dialog a Help button and F1, which open a place.
void offerHelp(QDialog& dialog, QDialogButtonBox& buttons, const QString& place);

/// Puts the parts of a dialog below each other and its buttons, with one for help, at the foot.
/// `characters`: about how many a line of its text has.
void layOut(QDialog& dialog, std::initializer_list<std::variant<QWidget*, QLayout*>> parts,
            QDialogButtonBox& buttons, const QString& helpPlace, int characters);

} // namespace posewire::gui
