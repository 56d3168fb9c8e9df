// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme/theme.h"

#include "app/gui/theme/icon_drawing.h"
#include "window_style.h"

#include <QFile>
#include <QFontDatabase>
#include <QFontMetrics>
#include <QIconEngine>
#include <QPainter>
#include <QPalette>
#include <QStyleFactory>
#include <QTextDocument>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace posewire::gui {

namespace {

Theme themeOf(bool isDark) {
    const auto either = [isDark](const char* dark, const char* light) {
        return QColor(isDark ? dark : light);
    };
    return {.isDark = isDark,
            .window = either("#1f2226", "#e9ebee"),
            .panel = either("#26292e", "#ffffff"),
            .raised = either("#2c3036", "#f4f5f7"),
            .header = either("#22252a", "#f1f3f5"),
            .line = either("#383d44", "#d5d9de"),
            .text = either("#e4e7eb", "#1d2126"),
            .dim = either("#9aa3ad", "#626b75"),
            .accent = either("#4c9bff", "#1f6feb"),
            .selection = either("#2f4a6b", "#dbe9fb"),
            .good = either("#4cc38a", "#127846"),
            .warning = either("#f2b84b", "#935d00"),
            .error = either("#ff6b5e", "#c62828"),
            .axisX = "#eb4034",
            .axisY = "#3cbe5a",
            .axisZ = "#4082f6",
            .plotFourth = either("#c79bff", "#8a4fd0")};
}

/// No grey but where something is secondary, lines that can be seen, and colours that are far from the
/// ground.
Theme highContrastOf(bool isDark) {
    const auto either = [isDark](const char* dark, const char* light) {
        return QColor(isDark ? dark : light);
    };
    Theme theme = themeOf(isDark);
    theme.window = theme.panel = theme.header = either("#000000", "#ffffff");
    theme.raised = either("#141414", "#f2f2f2");
    theme.line = either("#a0a0a0", "#5a5a5a");
    theme.text = either("#ffffff", "#000000");
    theme.dim = either("#d6d6d6", "#333333");
    theme.accent = either("#6cb8ff", "#0040c0");
    theme.selection = either("#00366e", "#b9d6ff");
    theme.good = either("#63f2a5", "#00552a");
    theme.warning = either("#ffd24a", "#633f00");
    theme.error = either("#ff9c92", "#980000");
    return theme;
}

Theme& current() {
    static Theme theme = themeOf(true);
    return theme;
}

/// That of the desktop as it is now, whatever this program has set for itself: which is taken away for that.
QPalette desktopPalette() {
    QApplication::setPalette(QPalette());
    return QApplication::palette();
}

QPalette paletteOf(const Theme& theme) {
    const std::pair<QPalette::ColorRole, QColor> colours[] = {
        {QPalette::Window, theme.window},
        {QPalette::WindowText, theme.text},
        {QPalette::Base, theme.panel},
        {QPalette::AlternateBase, theme.raised},
        {QPalette::Text, theme.text},
        {QPalette::PlaceholderText, theme.dim},
        {QPalette::Button, theme.raised},
        {QPalette::ButtonText, theme.text},
        {QPalette::BrightText, theme.error},
        {QPalette::Highlight, theme.selection},
        {QPalette::HighlightedText, theme.text},
        {QPalette::Link, theme.accent},
        {QPalette::LinkVisited, theme.accent},
        {QPalette::ToolTipBase, theme.raised},
        {QPalette::ToolTipText, theme.text},
        {QPalette::Light, theme.raised},
        {QPalette::Midlight, theme.raised},
        {QPalette::Mid, theme.line},
        {QPalette::Dark, theme.line},
        {QPalette::Shadow, theme.line},
    };
    QPalette palette;
    for (const auto& [role, colour] : colours) {
        palette.setColor(role, colour);
    }
    for (const auto role :
         {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::HighlightedText}) {
        palette.setColor(QPalette::Disabled, role, theme.dim);
    }
    return palette;
}

/// A colour between two, by channels: 0 is the first, 1 the second.
QColor mixed(const QColor& a, const QColor& b, double share) {
    const auto at = [share](int from, int to) { return static_cast<int>(from + (to - from) * share); };
    return {at(a.red(), b.red()), at(a.green(), b.green()), at(a.blue(), b.blue())};
}

/// Colours come from the theme, sizes from the metrics.
QString styleSheet(const Theme& theme, const QFontMetrics& metrics) {
    const auto pixels = [](int value) { return QString::number(value) + QStringLiteral("px"); };
    // Longer names first, so that no name is taken for the beginning of another.
    const std::array<std::pair<QString, QString>, 20> values{{
        {"@window", theme.window.name()},
        {"@panel", theme.panel.name()},
        {"@raised", theme.raised.name()},
        {"@header", theme.header.name()},
        {"@handle", mixed(theme.line, theme.dim, 0.35).name()},
        {"@line", theme.line.name()},
        {"@text", theme.text.name()},
        {"@dim", theme.dim.name()},
        {"@accent", theme.accent.name()},
        {"@selection", theme.selection.name()},
        {"@stripe", mixed(theme.panel, theme.window, 0.35).name()},
        {"@goodfill", mixed(theme.panel, theme.good, 0.16).name()},
        {"@errorfill", mixed(theme.panel, theme.error, 0.16).name()},
        {"@good", theme.good.name()},
        {"@error", theme.error.name()},
        {"@mark", theme.panel.lightness() < theme.text.lightness() ? "dark" : "light"},
        {"@box", pixels(metrics.height() - 3)},
        {"@row", pixels(metrics.height() + 8)},
        {"@menuv", pixels(std::max(3, metrics.height() / 4))},
        {"@buttonv", pixels(std::max(3, metrics.height() / 4))},
    }};
    const std::string_view style = windowQss();
    QString sheet = QString::fromUtf8(style.data(), static_cast<qsizetype>(style.size()));
    for (const auto& [name, value] : values) {
        sheet.replace(name, value);
    }
    return sheet;
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

struct HealthLook {
    QColor Theme::*colour;
    char16_t symbol;
};

const HealthLook& lookOf(Health health) {
    static constexpr HealthLook kLooks[] = {
        {&Theme::good, u'●'}, {&Theme::warning, u'▲'}, {&Theme::error, u'■'}, {&Theme::dim, u'○'}};
    return kLooks[static_cast<std::size_t>(health)];
}

class TintedIcon final : public QIconEngine {
public:
    TintedIcon(QByteArray picture, QColor colour)
        : m_picture(std::move(picture)), m_colour(std::move(colour)) {}

    void paint(QPainter* painter, const QRect& rectangle, QIcon::Mode mode, QIcon::State /*state*/) override {
        drawTinted(*painter, rectangle, m_picture, mode == QIcon::Disabled ? theme().dim : m_colour);
    }

    QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
        QPixmap pixmap(size);
        if (pixmap.isNull()) { // a button that has no room yet
            return pixmap;
        }
        pixmap.fill(Qt::transparent);
        QPainter painter(&pixmap);
        paint(&painter, QRect(QPoint(), size), mode, state);
        return pixmap;
    }

    [[nodiscard]] QIconEngine* clone() const override { return new TintedIcon(*this); }

private:
    QByteArray m_picture;
    QColor m_colour;
};

} // namespace

const Theme& theme() {
    return current();
}

QColor plotColour(int number) {
    static constexpr std::array<std::pair<const char*, const char*>, kPlotColours> kColours{{
        {"#58a6ff", "#1f6feb"},
        {"#ffb24d", "#b35900"},
        {"#56d08f", "#0f7b45"},
        {"#c79bff", "#8a4fd0"},
        {"#ff7f93", "#c4304f"},
        {"#45d0d8", "#007a8a"},
        {"#dccb5c", "#776800"},
        {"#b4bcc6", "#565f69"},
    }};
    if (number >= kPlotColours) {
        constexpr std::array kAxes{&Theme::axisX, &Theme::axisY, &Theme::axisZ};
        return theme().*kAxes[static_cast<std::size_t>(number - kPlotColours) % kAxes.size()];
    }
    const auto [dark, light] = kColours[static_cast<std::size_t>(std::max(0, number))];
    return theme().isDark ? dark : light;
}

QColor withAlpha(QColor colour, double alpha) {
    colour.setAlphaF(static_cast<float>(alpha));
    return colour;
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

Theme themeFor(ThemeChoice choice, const QPalette& desktop) {
    constexpr double kBlackOnWhite = 20;
    if (choice != ThemeChoice::System) {
        return themeOf(choice == ThemeChoice::Dark);
    }
    const QColor text = desktop.color(QPalette::WindowText);
    const QColor ground = desktop.color(QPalette::Window);
    const bool isDark = text.lightness() > ground.lightness();
    return contrast(text, ground) >= kBlackOnWhite ? highContrastOf(isDark) : themeOf(isDark);
}

void applyTheme(QApplication& application, ThemeChoice choice) {
    current() = themeFor(choice, choice == ThemeChoice::System ? desktopPalette() : QPalette());
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
    return theme().*lookOf(health).colour;
}

QString healthSymbol(Health health) {
    return QChar(lookOf(health).symbol);
}

QString healthText(Health health, const QString& text) {
    return healthSymbol(health) + QLatin1Char(' ') + text;
}

QIcon themedIcon(const QString& name, const QColor& colour) {
    QFile file(QStringLiteral(":/icons/%1.svg").arg(name));
    if (!file.open(QIODevice::ReadOnly)) {
        return {};
    }
    return QIcon(new TintedIcon(file.readAll(), colour.isValid() ? colour : theme().text));
}

QIcon applicationIcon() {
    return QIcon(QStringLiteral(":/icons/posewire.svg"));
}

QString toolTipText(const QString& plain) {
    // Keeps line breaks.
    const QString escaped = QStringLiteral("<qt><span style=\"white-space:pre-wrap\">%1</span></qt>");
    return Qt::mightBeRichText(plain) ? escaped.arg(plain.toHtmlEscaped()) : plain;
}

QString menuText(const QString& plain) {
    constexpr qsizetype kMost = 80;
    QString text = plain.simplified();
    if (text.size() > kMost) {
        text = text.left(kMost - 1) + QStringLiteral("…");
    }
    return text.replace(QLatin1Char('&'), QStringLiteral("&&"));
}

} // namespace posewire::gui
