// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/packet_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace posewire::gui {
namespace {

void expectSame(const PacketNumbers& numbers, const std::vector<std::uint64_t>& wanted) {
    ASSERT_EQ(numbers.size(), wanted.size());
    for (std::size_t place = 0; place < wanted.size(); ++place) {
        ASSERT_EQ(numbers[place], wanted[place]) << place;
        ASSERT_EQ(numbers.placeOf(wanted[place]), place);
        ASSERT_EQ(numbers.placeOf(wanted[place] + 1), place + 1);
    }
}

TEST(PacketNumbersTest, AreWhatWasAppendedAndNotDropped) {
    std::mt19937_64 random(1);
    for (const std::uint64_t spread : {1U, 3U, 100U, 20'000U}) {
        PacketNumbers numbers;
        std::vector<std::uint64_t> wanted;
        std::uint64_t next = random() % 10'000;
        for (int round = 0; round < 20; ++round) {
            for (int i = 0; i < 300; ++i) {
                numbers.append(next);
                wanted.push_back(next);
                next += 1 + random() % spread;
            }
            const std::uint64_t begin = wanted[random() % wanted.size()] + random() % 2;
            numbers.dropBefore(begin);
            wanted.erase(wanted.begin(), std::ranges::lower_bound(wanted, begin));
            expectSame(numbers, wanted);
        }
    }
}

TEST(PacketNumbersTest, BeginAnewWhereAllWereDropped) {
    PacketNumbers numbers;
    numbers.append({5, 4'095, 4'096, 9'000});
    numbers.dropBefore(1'000'000);
    EXPECT_TRUE(numbers.empty());
    EXPECT_EQ(numbers.placeOf(7), 0U);
    numbers.append({1'000'001, 1'234'567});
    expectSame(numbers, {1'000'001, 1'234'567});
}

TEST(PacketNumbersTest, ArePlacedBelowAndAboveAll) {
    PacketNumbers numbers;
    numbers.append({10'000, 10'001});
    EXPECT_EQ(numbers.placeOf(0), 0U);
    EXPECT_EQ(numbers.placeOf(UINT64_MAX), 2U);
    numbers.clear();
    EXPECT_EQ(numbers.placeOf(UINT64_MAX), 0U);
}

} // namespace
} // namespace posewire::gui
