// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme/theme.h"

#include "app/gui/theme/style_sheet.h"

#include <QFontDatabase>
#include <QFontMetrics>
#include <QPalette>
#include <QStyleFactory>

#include <algorithm>
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
            .good = "#127846",
            .warning = "#935d00",
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

double luminance(const QColor& colour) {
    const auto linear = [](double channel) {
        return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) +
           0.0722 * linear(colour.blueF());
}

} // namespace

const Theme& theme() {
    return current();
}

QColor mixed(const QColor& a, const QColor& b, double share) {
    const auto at = [share](int from, int to) { return static_cast<int>(from + (to - from) * share); };
    return {at(a.red(), b.red()), at(a.green(), b.green()), at(a.blue(), b.blue())};
}

QColor tinted(const QColor& colour) {
    constexpr double kShare = 0.12;
    return mixed(theme().panel, colour, kShare);
}

double contrast(const QColor& a, const QColor& b) {
    const double la = luminance(a);
    const double lb = luminance(b);
    return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}

QColor onSelection(const QColor& colour) {
    constexpr double kReadable = 4.5;
    constexpr double kStep = 0.1;
    QColor readable = colour;
    for (double share = kStep; share <= 1 && contrast(readable, theme().selection) < kReadable;
         share += kStep) {
        readable = mixed(colour, theme().text, share);
    }
    return readable;
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
