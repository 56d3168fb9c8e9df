// SPDX-License-Identifier: MIT
#include "core/log/sender_table.h"

#include <gtest/gtest.h>

namespace posewire::log {
namespace {

TEST(SenderTable, SameSenderHasTheSameId) {
    SenderTable table;
    const SenderId first = table.intern({"127.0.0.1:40001", Transport::Udp, 9763});
    EXPECT_EQ(table.intern({"127.0.0.1:40001", Transport::Udp, 9763}), first);
    EXPECT_EQ(table.size(), 1U);
}

TEST(SenderTable, AddressTransportAndPortEachMakeADifference) {
    SenderTable table;
    const SenderId first = table.intern({"127.0.0.1:40001", Transport::Udp, 9763});
    EXPECT_NE(table.intern({"127.0.0.1:40002", Transport::Udp, 9763}), first);
    EXPECT_NE(table.intern({"127.0.0.1:40001", Transport::Tcp, 9763}), first);
    EXPECT_NE(table.intern({"127.0.0.1:40001", Transport::Udp, 9764}), first);
    EXPECT_EQ(table.size(), 4U);
}

TEST(SenderTable, FindsWhatWasInternedAndNothingElse) {
    SenderTable table;
    const SenderId id = table.intern({"demo", Transport::Performer, 0});
    const auto info = table.find(id);
    ASSERT_NE(info, nullptr);
    EXPECT_EQ(*info, (SenderInfo{"demo", Transport::Performer, 0}));
    EXPECT_EQ(table.find(static_cast<SenderId>(1)), nullptr);
}

TEST(SenderTable, KeepsWhatIsHeldWhateverElseComes) {
    SenderTable table;
    const SenderId first = table.intern({"first", Transport::Udp, 1});
    const auto held = table.find(first);
    for (std::size_t i = 0; i < 2 * SenderTable::kNewest; ++i) {
        table.intern({std::to_string(i), Transport::Udp, 1});
    }
    EXPECT_EQ(table.find(first), held);
    EXPECT_EQ(table.intern({"first", Transport::Udp, 1}), first);
}

TEST(SenderTable, ForgetsWhatNobodyHolds) {
    SenderTable table;
    const SenderId first = table.intern({"first", Transport::Udp, 1});
    for (std::size_t i = 0; i < 100 * SenderTable::kNewest; ++i) {
        table.intern({std::to_string(i), Transport::Udp, 1});
    }
    EXPECT_EQ(table.size(), SenderTable::kNewest);
    EXPECT_EQ(table.find(first), nullptr);
    EXPECT_NE(table.intern({"first", Transport::Udp, 1}), first) << "a number is never used twice";
}

TEST(SenderTable, MayEndBeforeThoseWhoHold) {
    SenderTable::Held held;
    {
        SenderTable table;
        held = table.find(table.intern({"first", Transport::Udp, 1}));
    }
    EXPECT_EQ(held->address, "first");
}

} // namespace
} // namespace posewire::log
