// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme.h"

#include "app/gui/style_sheet.h"

#include <QFontDatabase>
#include <QFontMetrics>
#include <QPalette>
#include <QStyleFactory>

#include <cmath>

namespace posewire::gui {

namespace {

Theme darkTheme() {
    return {.isDark = true,
            .window = "#1f2226",
            .panel = "#26292e",
            .raised = "#2c3036",
            .header = "#22252a",
            .line = "#383d44",
            .text = "#e4e7eb",
            .dim = "#9aa3ad",
            .accent = "#4c9bff",
            .selection = "#2f4a6b",
            .good = "#4cc38a",
            .warning = "#f2b84b",
            .error = "#ff6b5e",
            .axisX = "#eb4034",
            .axisY = "#3cbe5a",
            .axisZ = "#4082f6",
            .plotFourth = "#c79bff"};
}

Theme lightTheme() {
    return {.isDark = false,
            .window = "#e9ebee",
            .panel = "#ffffff",
            .raised = "#f4f5f7",
            .header = "#f1f3f5",
            .line = "#d5d9de",
            .text = "#1d2126",
            .dim = "#626b75",
            .accent = "#1f6feb",
            .selection = "#dbe9fb",
            .good = "#14804a",
            .warning = "#9a6200",
            .error = "#c62828",
            .axisX = "#eb4034",
            .axisY = "#3cbe5a",
            .axisZ = "#4082f6",
            .plotFourth = "#8a4fd0"};
}

Theme& current() {
    static Theme theme = darkTheme();
    return theme;
}

/// As the desktop had it before this program set its own palette.
bool desktopIsDark(const QApplication& application) {
    static const bool isDark = application.palette().color(QPalette::WindowText).lightness() >
                               application.palette().color(QPalette::Window).lightness();
    return isDark;
}

QPalette paletteOf(const Theme& theme) {
    QPalette palette;
    palette.setColor(QPalette::Window, theme.window);
    palette.setColor(QPalette::WindowText, theme.text);
    palette.setColor(QPalette::Base, theme.panel);
    palette.setColor(QPalette::AlternateBase, theme.raised);
    palette.setColor(QPalette::Text, theme.text);
    palette.setColor(QPalette::PlaceholderText, theme.dim);
    palette.setColor(QPalette::Button, theme.raised);
    palette.setColor(QPalette::ButtonText, theme.text);
    palette.setColor(QPalette::BrightText, theme.error);
    palette.setColor(QPalette::Highlight, theme.selection);
    palette.setColor(QPalette::HighlightedText, theme.text);
    palette.setColor(QPalette::Link, theme.accent);
    palette.setColor(QPalette::LinkVisited, theme.accent);
    palette.setColor(QPalette::ToolTipBase, theme.raised);
    palette.setColor(QPalette::ToolTipText, theme.text);
    palette.setColor(QPalette::Light, theme.raised);
    palette.setColor(QPalette::Midlight, theme.raised);
    palette.setColor(QPalette::Mid, theme.line);
    palette.setColor(QPalette::Dark, theme.line);
    palette.setColor(QPalette::Shadow, theme.line);
    for (const auto role :
         {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::HighlightedText}) {
        palette.setColor(QPalette::Disabled, role, theme.dim);
    }
    return palette;
}

bool hasEqualDigits(const QFont& font) {
    const QFontMetricsF metrics(font);
    const double width = metrics.horizontalAdvance(QLatin1Char('0'));
    for (char digit = '1'; digit <= '9'; ++digit) {
        if (std::abs(metrics.horizontalAdvance(QLatin1Char(digit)) - width) > 0.01) {
            return false;
        }
    }
    return true;
}

} // namespace

const Theme& theme() {
    return current();
}

QColor tinted(const QColor& colour) {
    constexpr double kShare = 0.12;
    const QColor& panel = theme().panel;
    const auto mix = [](int from, int to) { return static_cast<int>(from + (to - from) * kShare); };
    return {mix(panel.red(), colour.red()), mix(panel.green(), colour.green()),
            mix(panel.blue(), colour.blue())};
}

void applyTheme(QApplication& application, ThemeChoice choice) {
    const bool desktopDark = desktopIsDark(application);
    const bool isDark = choice == ThemeChoice::Dark || (choice == ThemeChoice::System && desktopDark);
    current() = isDark ? darkTheme() : lightTheme();
    QApplication::setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
    QApplication::setPalette(paletteOf(current()));
    application.setStyleSheet(styleSheet(current(), QFontMetrics(QApplication::font())));
}

QFont monospaceFont() {
    QFont font = QFontDatabase::systemFont(QFontDatabase::FixedFont);
    font.setPointSizeF(QApplication::font().pointSizeF());
    return font;
}

QFont tabularFont() {
    const QFont font = QApplication::font();
    return hasEqualDigits(font) ? font : monospaceFont();
}

QColor healthColour(Health health) {
    switch (health) {
    case Health::Good:
        return theme().good;
    case Health::Warning:
        return theme().warning;
    case Health::Error:
        return theme().error;
    case Health::Unknown:
        break;
    }
    return theme().dim;
}

QString healthSymbol(Health health) {
    switch (health) {
    case Health::Good:
        return QStringLiteral("●");
    case Health::Warning:
        return QStringLiteral("▲");
    case Health::Error:
        return QStringLiteral("■");
    case Health::Unknown:
        break;
    }
    return QStringLiteral("○");
}

} // namespace posewire::gui
