// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme/theme.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTabBar>
#include <QTest>
#include <QToolButton>
#include <QVBoxLayout>

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

class ThemeTest : public testing::TestWithParam<ThemeChoice> {
protected:
    ThemeTest() { applyTheme(*qApp, GetParam()); }
    static std::vector<QColor> texts() {
        return {theme().text, theme().dim, theme().good, theme().warning, theme().error};
    }
};

TEST_P(ThemeTest, TextStandsOutOnEveryGround) {
    for (const QColor& ground : {theme().window, theme().panel, theme().raised, theme().header}) {
        for (const QColor& text : texts()) {
            EXPECT_GE(contrast(text, ground), 4.5)
                << text.name().toStdString() << " on " << ground.name().toStdString();
        }
    }
}

TEST_P(ThemeTest, TextStandsOutOnASelectedRow) {
    for (const QColor& text : texts()) {
        EXPECT_GE(contrast(onSelection(text), theme().selection), 4.5) << text.name().toStdString();
    }
    EXPECT_EQ(onSelection(theme().text), theme().text);
}

TEST_P(ThemeTest, WhatIsOnAndHasTheKeyboardLooksOtherThanWhatIsOnlyOn) {
    QWidget window;
    QVBoxLayout column(&window);
    for (const char* look : {"framed", "flat", "live"}) {
        auto* button = new QToolButton;
        button->setText(QStringLiteral("History"));
        button->setProperty(look, true);
        button->setCheckable(true);
        button->setChecked(true);
        button->setFocusPolicy(Qt::StrongFocus);
        column.addWidget(button);
    }
    auto* tabs = new QTabBar;
    tabs->addTab(QStringLiteral("Segments"));
    column.addWidget(tabs);
    auto* elsewhere = new QPushButton;
    column.addWidget(elsewhere);
    window.show();
    window.activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&window));
    for (QWidget* widget : window.findChildren<QWidget*>(Qt::FindDirectChildrenOnly)) {
        elsewhere->setFocus();
        const QImage without = widget->grab().toImage();
        widget->setFocus();
        EXPECT_TRUE(widget == elsewhere || widget->grab().toImage() != without)
            << widget->metaObject()->className();
    }
}

TEST_P(ThemeTest, WhatHasTheKeyboardHasAFrameThatShowsIt) {
    QWidget window;
    QVBoxLayout column(&window);
    for (QWidget* field :
         std::initializer_list<QWidget*>{new QLineEdit, new QSpinBox, new QDoubleSpinBox, new QComboBox,
                                         new QPushButton, new QPlainTextEdit}) {
        column.addWidget(field);
    }
    window.show();
    window.activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&window));
    const auto fields = window.findChildren<QWidget*>(Qt::FindDirectChildrenOnly);
    const auto accents = [](QWidget& field) {
        const QImage image = field.grab().toImage();
        int count = 0;
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < image.width(); ++x) {
                count += image.pixelColor(x, y) == theme().accent ? 1 : 0;
            }
        }
        return count;
    };
    for (QWidget* field : fields) {
        fields.front() == field ? fields.back()->setFocus() : fields.front()->setFocus();
        const int before = accents(*field);
        field->setFocus();
        EXPECT_GT(accents(*field), before + 10) << field->metaObject()->className();
    }
}

QPalette desktop(const char* text, const char* ground) {
    QPalette palette;
    palette.setColor(QPalette::WindowText, QColor(text));
    palette.setColor(QPalette::Window, QColor(ground));
    return palette;
}

TEST(ThemeFor, TheSystemsIsThatOfTheDesktop) {
    const Theme dark = themeFor(ThemeChoice::Dark, {});
    const Theme light = themeFor(ThemeChoice::Light, {});
    EXPECT_EQ(themeFor(ThemeChoice::System, desktop("#eeeeee", "#303030")).text, dark.text);
    EXPECT_EQ(themeFor(ThemeChoice::System, desktop("#202020", "#efefef")).text, light.text);
    EXPECT_EQ(themeFor(ThemeChoice::System, desktop("#000000", "#efefef")).text, light.text);
    EXPECT_EQ(themeFor(ThemeChoice::Dark, desktop("#000000", "#ffffff")).text, dark.text)
        << "a choice counts more than the desktop";
}

TEST(ThemeFor, ADesktopOfHighContrastGetsItAsTheGuidelinesAskForAtMost) {
    for (const Theme& theme : {themeFor(ThemeChoice::System, desktop("#ffffff", "#000000")),
                               themeFor(ThemeChoice::System, desktop("#000000", "#ffffff"))}) {
        EXPECT_GE(contrast(theme.text, theme.panel), 20);
        for (const QColor& colour : {theme.dim, theme.good, theme.warning, theme.error, theme.accent}) {
            EXPECT_GE(contrast(colour, theme.panel), 7) << colour.name().toStdString();
        }
        EXPECT_GE(contrast(theme.line, theme.panel), 3) << "edges are seen";
        EXPECT_GE(contrast(theme.text, theme.selection), 7);
    }
    EXPECT_TRUE(themeFor(ThemeChoice::System, desktop("#ffffff", "#000000")).isDark);
    EXPECT_FALSE(themeFor(ThemeChoice::System, desktop("#000000", "#ffffff")).isDark);
}

TEST(ApplyTheme, ReadsTheDesktopAgainAfterAnotherThemeWasChosen) {
    applyTheme(*qApp, ThemeChoice::System);
    const bool isDark = theme().isDark;
    applyTheme(*qApp, isDark ? ThemeChoice::Light : ThemeChoice::Dark);
    EXPECT_NE(theme().isDark, isDark);
    applyTheme(*qApp, ThemeChoice::System);
    EXPECT_EQ(theme().isDark, isDark) << "our own palette is not that of the desktop";
}

TEST(Contrast, IsThatOfTheGuidelines) {
    EXPECT_DOUBLE_EQ(contrast(Qt::black, Qt::white), 21.0);
    EXPECT_NEAR(contrast(QColor("#767676"), Qt::white), 4.54, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Themes, ThemeTest, testing::Values(ThemeChoice::Dark, ThemeChoice::Light));

} // namespace
} // namespace posewire::gui
