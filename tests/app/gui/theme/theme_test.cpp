// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/theme/theme.h"

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

TEST(Contrast, IsThatOfTheGuidelines) {
    EXPECT_DOUBLE_EQ(contrast(Qt::black, Qt::white), 21.0);
    EXPECT_NEAR(contrast(QColor("#767676"), Qt::white), 4.54, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Themes, ThemeTest, testing::Values(ThemeChoice::Dark, ThemeChoice::Light));

} // namespace
} // namespace posewire::gui
