// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/window/dock_layout.h"

#include "app/gui/panel.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace posewire::gui {
namespace {

TEST(DockLayout, EveryShippedLayoutPlacesDocksThatExist) {
    for (const QString& name : layoutNames()) {
        const auto layout = findLayout(name);
        ASSERT_TRUE(layout) << layout.error().toStdString();
        EXPECT_EQ(layout->name, name);
        const bool hasDock = std::ranges::any_of(layout->places, [](const DockLayout::Place& place) {
            return std::ranges::any_of(panelTable(),
                                       [&](const PanelInfo& info) { return place.docks.contains(info.id); });
        });
        EXPECT_TRUE(hasDock) << name.toStdString();
    }
}

TEST(DockLayout, NamesAreFoundWhateverTheirCase) {
    EXPECT_TRUE(findLayout("check"));
    EXPECT_TRUE(findLayout("INSPECT"));
}

TEST(DockLayout, SaysWhichLayoutsThereAreWhereANameIsWrong) {
    const auto layout = findLayout("no-such-layout");
    ASSERT_FALSE(layout);
    EXPECT_TRUE(layout.error().contains("Check, Debug, Inspect"));
}

TEST(DockLayout, RejectsWhatIsNoLayout) {
    EXPECT_FALSE(parseLayout("{"));
    EXPECT_FALSE(parseLayout("[]"));
    EXPECT_FALSE(parseLayout("{\"name\": \"Empty\", \"areas\": {}}"));
}

TEST(DockLayout, ReadsPlacesTabsSharesAndExtents) {
    const auto layout = parseLayout(R"({"name": "Mine", "areas": {"right": {"extent": 0.3,
        "places": [{"docks": ["a", "b"], "share": 4}, {"docks": ["c"]}]}}})");
    ASSERT_TRUE(layout);
    ASSERT_EQ(layout->places.size(), 2U);
    EXPECT_EQ(layout->places[0].docks, QStringList({"a", "b"}));
    EXPECT_EQ(layout->places[0].share, 4);
    EXPECT_EQ(layout->places[1].share, 1);
    EXPECT_DOUBLE_EQ(layout->extents.at(Qt::RightDockWidgetArea), 0.3);
}

} // namespace
} // namespace posewire::gui
