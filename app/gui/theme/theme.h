// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QApplication>
#include <QColor>
#include <QFont>
#include <QIcon>
#include <QString>
#include <QVariant>

class QPalette;

namespace posewire::gui {

/// Every colour of the window; no other file has one.
struct Theme {
    bool isDark = true;
    QColor window, panel, raised, header;
    QColor line;
    QColor text, dim;
    QColor accent, selection;
    QColor good, warning, error;
    QColor axisX, axisY, axisZ;
    QColor plotFourth; ///< a fourth curve beside x, y, z
};

enum class ThemeChoice { System, Dark, Light };

/// The theme in use: that of the last applyTheme(), the dark one before. There is one for the whole
/// application, as there is one palette and one style sheet, so it is not passed around. Only for the
/// window's thread. What keeps a colour asks again on QEvent::PaletteChange or StyleChange.
[[nodiscard]] const Theme& theme();

/// The colour at an opacity of 0 to 1.
[[nodiscard]] QColor withAlpha(QColor colour, double alpha);

/// The panel's colour with a little of another, to fill what is marked by that colour.
[[nodiscard]] QColor tinted(const QColor& colour);

/// Contrast of two colours, 1 to 21 (WCAG 2.1, by relative luminance).
[[nodiscard]] double contrast(const QColor& a, const QColor& b);

/// A colour of text for a selected row: mixed with the text's own until it stands out as 4.5 : 1.
[[nodiscard]] QColor onSelection(const QColor& colour);

/// The theme of a choice on a desktop with that palette. A desktop with black texts on white, or white on
/// black, wants high contrast, and gets it if its theme is followed.
[[nodiscard]] Theme themeFor(ThemeChoice choice, const QPalette& desktop);
void applyTheme(QApplication& application, ThemeChoice choice);

/// Colours of curves, from 0 on: those of a plot first, as far apart as can be; then those of the axes x, y,
/// z.
inline constexpr int kPlotColours = 8;
[[nodiscard]] QColor plotColour(int number);

/// Fonts from the desktop's own, sizes from its metrics.
[[nodiscard]] QFont monospaceFont();
[[nodiscard]] QFont
tabularFont(); ///< the desktop's font; its digits are of equal width or the monospace's are used

/// Health in shape and colour and text: ● good, ▲ warning, ■ error.
enum class Health { Good, Warning, Error, Unknown };
/// Pixels of a mark at the least: what was lost is seen, however little.
inline constexpr double kLeastMark = 2.5;
[[nodiscard]] QColor healthColour(Health health);
[[nodiscard]] QString healthSymbol(Health health);
/// "▲ lossy": a text after the symbol.
[[nodiscard]] QString healthText(Health health, const QString& text);

/// An icon of resources/icons by its file name without ending, in the theme's text colour (or `colour`),
/// sharp at any pixel ratio. Made again when the theme changes: ask again then. Null if there is no such
/// icon.
[[nodiscard]] QIcon themedIcon(const QString& name, const QColor& colour = {});

[[nodiscard]] QIcon applicationIcon();

// Qt guesses in tooltips whether a text is HTML, and takes an & in menus and on buttons for a mnemonic. If a
// text is not a literal of ours, these make it plain; for labels and messages see widgets.h.

/// A tooltip that shows a plain text as it is: escaped where Qt would take it for HTML, which might load
/// pictures from files.
[[nodiscard]] QString toolTipText(const QString& plain);

/// The same for models: nothing for an empty one.
[[nodiscard]] inline QVariant toolTipOf(const QString& plain) {
    return plain.isEmpty() ? QVariant() : QVariant(toolTipText(plain));
}

/// An entry of a menu or the text of a button: no mnemonic, one line, at most 80 characters.
[[nodiscard]] QString menuText(const QString& plain);

} // namespace posewire::gui
