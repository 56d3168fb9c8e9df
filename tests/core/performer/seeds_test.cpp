// SPDX-License-Identifier: MIT
#include "core/performer/performer.h"

#include "core/performer/motion.h"
#include "core/wire/codec.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <ostream>
#include <set>
#include <string>
#include <vector>

/// The same settings give the same bytes, and each setting does what it says and nothing else.
namespace posewire::performer {
namespace {

/// All bytes of some frames.
std::vector<std::byte> bytesOf(const PerformerSettings& settings, std::uint64_t from = 0,
                               std::uint64_t count = 3) {
    Performer performer(settings);
    std::vector<std::byte> all;
    for (std::uint64_t index = from; index < from + count; ++index) {
        for (const wire::Datagram& datagram : performer.frame(index)) {
            const auto bytes = wire::encode(datagram);
            EXPECT_TRUE(bytes.has_value());
            all.insert(all.end(), bytes->begin(), bytes->end());
        }
    }
    return all;
}

struct Performance {
    std::string motion;
    Revision revision = Revision::N;
    friend std::ostream& operator<<(std::ostream& out, const Performance& performance) {
        return out << performance.motion << ", revision " << int(performance.revision);
    }
};

class Seeds : public testing::TestWithParam<Performance> {
protected:
    static PerformerSettings settings(std::uint64_t seed) {
        PerformerSettings settings;
        settings.motion = GetParam().motion;
        settings.revision = GetParam().revision;
        settings.seed = seed;
        return settings;
    }
};

TEST_P(Seeds, GiveEqualStreams) {
    EXPECT_EQ(bytesOf(settings(5)), bytesOf(settings(5)));
    EXPECT_EQ(bytesOf(settings(5), 10'000), bytesOf(settings(5), 10'000));
    EXPECT_NE(bytesOf(settings(5)), bytesOf(settings(6)));
    EXPECT_NE(bytesOf(settings(0)), bytesOf(settings(std::numeric_limits<std::uint64_t>::max())));
}

TEST_P(Seeds, GiveEveryFrameWhateverWasAskedForBefore) {
    Performer performer(settings(3));
    performer.frame(70'000);
    performer.frame(12);
    std::vector<wire::Datagram> reused;
    for (const std::uint64_t index : {500U, 4U, 501U, 0U}) {
        performer.frameInto(index, reused);
        const auto fresh = Performer(settings(3)).frame(index);
        ASSERT_EQ(reused.size(), fresh.size()) << index;
        for (std::size_t i = 0; i < fresh.size(); ++i) {
            ASSERT_EQ(*wire::encode(reused[i]), *wire::encode(fresh[i])) << index;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Performances, Seeds,
                         testing::Values(Performance{"walk"}, Performance{"idle"}, Performance{"wave"},
                                         Performance{"squat"}, Performance{"walk", Revision::E},
                                         Performance{"idle", Revision::K}));

TEST(PerformerCounter, PassesTheWrapAround) {
    PerformerSettings settings;
    settings.types = {24};
    settings.characters = 1;
    settings.firstSample = 0xfffffffeU;
    Performer performer(settings);
    std::vector<std::uint32_t> samples;
    for (std::uint64_t index = 0; index < 4; ++index) {
        samples.push_back(performer.frame(index).front().header.sampleCounter);
    }
    EXPECT_EQ(samples, (std::vector<std::uint32_t>{0xfffffffeU, 0xffffffffU, 0, 1}));
}

TEST(PerformerClock, CountsMillisecondsFromItsStart) {
    for (const double rateHz : {60.0, 100.0, 240.0, 1'000.0}) {
        PerformerSettings settings;
        settings.types = {24};
        settings.characters = 1;
        settings.rateHz = rateHz;
        settings.startTimeOfDayMs = 1'000;
        Performer performer(settings);
        for (const std::uint64_t index : {0U, 1U, 7U, 59U, 100'000U}) {
            const double expected = 1'000 + 1'000 * static_cast<double>(index) / rateHz;
            EXPECT_NEAR(performer.frame(index).front().header.timeCode, expected, 1.0) << rateHz << " Hz";
        }
    }
}

TEST(PerformerCharacters, AreTheSameWhoeverElseIsThere) {
    // Only the walkers keep out of each other's way; who stands is who he is.
    PerformerSettings settings;
    settings.types = {2};
    settings.motion = "idle";
    settings.characters = 32;
    const auto all = Performer(settings).frame(100);
    ASSERT_EQ(all.size(), 32U);
    std::set<int> ids;
    std::set<std::vector<std::byte>> bodies;
    for (const wire::Datagram& datagram : all) {
        ids.insert(datagram.header.character);
        wire::Datagram anonymous = datagram;
        anonymous.header.character = 0;
        bodies.insert(*wire::encode(anonymous));
    }
    EXPECT_EQ(ids.size(), 32U);
    EXPECT_EQ(*ids.rbegin(), 31);
    EXPECT_EQ(bodies.size(), 32U) << "no two stand in the same pose on the same spot";
}

TEST(PerformerSettings, HaveBoundsThatBelongToThem) {
    const auto isFine = [](int characters, double rateHz, int props) {
        PerformerSettings settings;
        settings.characters = characters;
        settings.rateHz = rateHz;
        settings.props = props;
        return !findProblem(settings);
    };
    EXPECT_TRUE(isFine(1, 1.0, 0));
    EXPECT_TRUE(isFine(kMaxCharacters, 1'000.0, 4));
    EXPECT_FALSE(isFine(kMaxCharacters + 1, 240.0, 0));
    EXPECT_FALSE(isFine(-1, 240.0, 0));
    EXPECT_FALSE(isFine(1, 0.999, 0));
    EXPECT_FALSE(isFine(1, 1'000.001, 0));
    EXPECT_FALSE(isFine(1, std::nan(""), 0));
    EXPECT_FALSE(isFine(1, std::numeric_limits<double>::infinity(), 0));
    EXPECT_FALSE(isFine(1, 240.0, -1));
}

TEST(PerformerTypes, AreThoseOfTheRevision) {
    const auto has = [](Revision revision, std::uint8_t type) {
        const auto types = typesOf(revision);
        return std::find(types.begin(), types.end(), type) != types.end();
    };
    for (const std::uint8_t type : std::initializer_list<std::uint8_t>{1, 2, 3, 12}) {
        for (const Revision revision : {Revision::E, Revision::J, Revision::K, Revision::N}) {
            EXPECT_TRUE(has(revision, type)) << int{type};
        }
    }
    for (const std::uint8_t type : std::initializer_list<std::uint8_t>{5, 13, 20, 21, 22, 23, 24, 25}) {
        EXPECT_FALSE(has(Revision::E, type)) << int{type};
        EXPECT_TRUE(has(Revision::J, type)) << int{type};
        EXPECT_TRUE(has(Revision::N, type)) << int{type};
    }
    for (const std::uint8_t type : std::initializer_list<std::uint8_t>{10, 11}) {
        EXPECT_TRUE(has(Revision::E, type)) << int{type};
        EXPECT_FALSE(has(Revision::N, type)) << int{type};
    }
}

} // namespace
} // namespace posewire::performer
