// SPDX-License-Identifier: MIT
#include "core/log/source_table.h"

#include <gtest/gtest.h>

namespace posewire::log {
namespace {

TEST(SourceTable, SameSourceHasTheSameId) {
    SourceTable table;
    const SourceId first = table.intern({"127.0.0.1:40001", Transport::Udp, 9763});
    EXPECT_EQ(table.intern({"127.0.0.1:40001", Transport::Udp, 9763}), first);
    EXPECT_EQ(table.size(), 1U);
}

TEST(SourceTable, AddressTransportAndPortEachMakeADifference) {
    SourceTable table;
    const SourceId first = table.intern({"127.0.0.1:40001", Transport::Udp, 9763});
    EXPECT_NE(table.intern({"127.0.0.1:40002", Transport::Udp, 9763}), first);
    EXPECT_NE(table.intern({"127.0.0.1:40001", Transport::Tcp, 9763}), first);
    EXPECT_NE(table.intern({"127.0.0.1:40001", Transport::Udp, 9764}), first);
    EXPECT_EQ(table.size(), 4U);
}

TEST(SourceTable, FindsWhatWasInternedAndNothingElse) {
    SourceTable table;
    const SourceId id = table.intern({"demo", Transport::Performer, 0});
    const SourceInfo* info = table.find(id);
    ASSERT_NE(info, nullptr);
    EXPECT_EQ(*info, (SourceInfo{"demo", Transport::Performer, 0}));
    EXPECT_EQ(table.find(static_cast<SourceId>(1)), nullptr);
}

TEST(SourceTable, EntriesNeverMove) {
    SourceTable table;
    const SourceInfo* first = table.find(table.intern({"first", Transport::Udp, 1}));
    for (int i = 0; i < 1000; ++i) {
        table.intern({std::to_string(i), Transport::Udp, 1});
    }
    EXPECT_EQ(table.find(static_cast<SourceId>(0)), first);
    EXPECT_EQ(first->address, "first");
}

TEST(SourceTable, ForgedAddressesShareTheLastEntry) {
    SourceTable table;
    for (std::size_t i = 0; i < 2 * SourceTable::kCapacity; ++i) {
        table.intern({std::to_string(i), Transport::Udp, 9763});
    }
    EXPECT_EQ(table.size(), SourceTable::kCapacity);
    const SourceId last = table.intern({"one more", Transport::Udp, 9763});
    EXPECT_EQ(static_cast<std::size_t>(last), SourceTable::kCapacity - 1);
    EXPECT_EQ(table.find(last)->address, "other sources");
    EXPECT_EQ(static_cast<std::size_t>(table.intern({"17", Transport::Udp, 9763})), 17U);
}

} // namespace
} // namespace posewire::log
