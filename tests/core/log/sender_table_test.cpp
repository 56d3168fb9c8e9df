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
    const SenderInfo* info = table.find(id);
    ASSERT_NE(info, nullptr);
    EXPECT_EQ(*info, (SenderInfo{"demo", Transport::Performer, 0}));
    EXPECT_EQ(table.find(static_cast<SenderId>(1)), nullptr);
}

TEST(SenderTable, EntriesNeverMove) {
    SenderTable table;
    const SenderInfo* first = table.find(table.intern({"first", Transport::Udp, 1}));
    for (int i = 0; i < 1000; ++i) {
        table.intern({std::to_string(i), Transport::Udp, 1});
    }
    EXPECT_EQ(table.find(static_cast<SenderId>(0)), first);
    EXPECT_EQ(first->address, "first");
}

TEST(SenderTable, ForgedAddressesShareTheLastEntry) {
    SenderTable table;
    for (std::size_t i = 0; i < 2 * SenderTable::kCapacity; ++i) {
        table.intern({std::to_string(i), Transport::Udp, 9763});
    }
    EXPECT_EQ(table.size(), SenderTable::kCapacity);
    const SenderId last = table.intern({"one more", Transport::Udp, 9763});
    EXPECT_EQ(static_cast<std::size_t>(last), SenderTable::kCapacity - 1);
    EXPECT_EQ(table.find(last)->address, "other sources");
    EXPECT_EQ(static_cast<std::size_t>(table.intern({"17", Transport::Udp, 9763})), 17U);
}

} // namespace
} // namespace posewire::log
