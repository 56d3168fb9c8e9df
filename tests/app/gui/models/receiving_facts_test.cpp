// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/receiving_facts.h"

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

using namespace std::chrono_literals;

TEST(ReceivingFacts, FollowTheStateAndWarnOfASmallBuffer) {
    ReceivingState state;
    const std::vector<Property> facts = receivingFacts([&state] { return state; });
    ASSERT_EQ(facts.size(), 2U);
    EXPECT_EQ(facts[0].read().text, "no UDP port");
    EXPECT_EQ(facts[0].read().health, Health::Unknown);
    state.receiveBufferBytes = std::int64_t{4} << 20;
    EXPECT_EQ(facts[0].read().display(), QStringLiteral("● 4 MB"));
    state.receiveBufferBytes = 212'992 / 2;
    EXPECT_EQ(facts[0].read().display(), QStringLiteral("▲ 104 KB"));
    EXPECT_TRUE(facts[0].read().toolTip.contains("rmem_max"));
    state.longestDelay = 47'300us;
    EXPECT_EQ(facts[1].read().health, Health::Good);
    state.longestDelay = 400ms;
    EXPECT_EQ(facts[1].read().health, Health::Warning);
}

} // namespace
} // namespace posewire::gui
