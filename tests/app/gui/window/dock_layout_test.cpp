// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/base/dock_layout.h"

#include "app/gui/panels/panels.h"

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

QStringList docksOfTheProgram() {
    QStringList docks;
    for (const PanelInfo& info : panelTable()) {
        docks += info.id;
    }
    return docks;
}

TEST(DockLayout, EveryShippedLayoutNamesOnlyDocksThatExist) {
    for (const QString& name : layoutNames()) {
        const auto layout = findLayout(name);
        ASSERT_TRUE(layout) << layout.error().toStdString();
        EXPECT_EQ(layout->name, name);
        EXPECT_TRUE(unknownDocks(*layout, docksOfTheProgram()).isEmpty())
            << name.toStdString() << ": "
            << unknownDocks(*layout, docksOfTheProgram()).join(", ").toStdString();
    }
}

TEST(DockLayout, NamesTheDocksThatTheProgramDoesNotHave) {
    const auto layout = parseLayout(R"({"name": "Mine", "areas": {
        "left": {"places": [{"docks": ["characters", "charts"]}]},
        "bottom": {"places": [{"docks": ["eventz"]}]}}})");
    ASSERT_TRUE(layout);
    EXPECT_EQ(unknownDocks(*layout, docksOfTheProgram()), QStringList({"charts", "eventz"}));
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

TEST(DockLayout, OfANewerProgramIsRejectedAndOneWithoutAVersionIsTheFirst) {
    const QByteArray areas = R"("areas": {"left": {"places": [{"docks": ["packets"]}]}}})";
    EXPECT_TRUE(parseLayout("{" + areas));
    EXPECT_TRUE(parseLayout("{\"schema\": 1, " + areas));
    const auto newer = parseLayout("{\"schema\": 2, " + areas);
    ASSERT_FALSE(newer);
    EXPECT_TRUE(newer.error().contains("version is 2"));
    EXPECT_FALSE(parseLayout("{\"schema\": 0, " + areas));
}

TEST(DockLayout, ReadsPlacesTabsSharesAndExtents) {
    const auto layout = parseLayout(R"({"name": "Mine", "areas": {"right": {"extent": 0.3,
        "places": [{"docks": ["a", "b"], "share": 4}, {"docks": ["c"]}]}}})");
    ASSERT_TRUE(layout);
    const DockLayout::Area& right = layout->areas.at(Qt::RightDockWidgetArea);
    ASSERT_EQ(right.places.size(), 2U);
    EXPECT_EQ(right.places[0].docks, QStringList({"a", "b"}));
    EXPECT_EQ(right.places[0].share, 4);
    EXPECT_EQ(right.places[1].share, 1);
    EXPECT_DOUBLE_EQ(right.extent, 0.3);
}

TEST(DockLayout, ClipsSharesSoThatTheirSumCanBeCalculated) {
    const auto layout = parseLayout(R"({"areas": {"left": {"extent": 1e308, "places": [
        {"docks": ["a"], "share": 2147483647}, {"docks": ["b"], "share": -5}, "c"]}}})");
    ASSERT_TRUE(layout);
    const DockLayout::Area& left = layout->areas.at(Qt::LeftDockWidgetArea);
    EXPECT_EQ(left.places[0].share, 100);
    EXPECT_EQ(left.places[1].share, 1);
    EXPECT_TRUE(left.places[2].docks.isEmpty());
    EXPECT_DOUBLE_EQ(left.extent, 0.8);
}

} // namespace
} // namespace posewire::gui
