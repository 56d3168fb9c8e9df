// SPDX-License-Identifier: MIT
#include "core/export/comparison/alignment.h"

#include "core/wire/codec.h"
#include "tests/core/export/comparison/recordings.h"

#include <gmock/gmock.h>

namespace posewire::exporting {
namespace {

/// Which sample of the second recording each of the first has; 0 for none.
std::vector<std::uint32_t> partnersOf(const Recording& first, const Recording& second,
                                      const Alignment& alignment) {
    const Partners partners(first.timetable(), second.timetable(), alignment);
    std::vector<std::uint32_t> samples;
    for (const SampleMoment& moment : partners.first().samples()) {
        const auto place = partners.of(moment);
        samples.push_back(place ? partners.second().samples()[*place].sample : 0);
    }
    return samples;
}

std::vector<std::uint32_t> from(std::uint32_t first, std::size_t count) {
    std::vector<std::uint32_t> samples(count);
    for (std::size_t i = 0; i < count; ++i) {
        samples[i] = first + static_cast<std::uint32_t>(i);
    }
    return samples;
}

Recording::Change withoutTimeCode() {
    return [](wire::Datagram& datagram) {
        datagram.header.timeCode = 0;
        return true;
    };
}

TEST(AlignmentTest, KnowsWhenEachSampleWasMade) {
    Recording recording;
    recording.perform(Recording::settings(), 0, 120);
    const auto table = recording.timetable();
    ASSERT_EQ(table->samples().size(), 120U);
    EXPECT_EQ(table->step(), 1U);
    EXPECT_EQ(table->rateHz(), 60);
    EXPECT_NEAR(table->millisecondsOf(table->samples()[90]), 1500, 1e-6);
    SampleMoment later = table->samples().back(); // one that is yet to come, delayed on its way
    later.sample += 6;
    later.packet += 6;
    later.stamp += 250ms;
    EXPECT_NEAR(table->millisecondsOf(later), (119 + 6) * 1000.0 / 60, 1e-6);
}

TEST(AlignmentTest, TimeCodesFindTheSameMomentWhateverTheCounters) {
    Recording first;
    Recording second;
    auto renumbered = Recording::settings();
    renumbered.firstSample = 5000;
    first.perform(Recording::settings(), 0, 100);
    second.perform(renumbered, 30, 200);
    EXPECT_EQ(naturalAlignment(*first.timetable(), *second.timetable()), AlignBy::TimeCode);
    auto expected = from(5000, 100);
    std::fill_n(expected.begin(), 30, 0);
    EXPECT_EQ(partnersOf(first, second, {AlignBy::TimeCode, 0}), expected);
}

TEST(AlignmentTest, CountersAlignWhereTimeCodesSayNothing) {
    Recording first;
    Recording second;
    first.perform(Recording::settings(), 0, 50, withoutTimeCode());
    second.perform(Recording::settings(), 20, 90, withoutTimeCode());
    EXPECT_EQ(naturalAlignment(*first.timetable(), *second.timetable()), AlignBy::Sample);
    auto expected = from(1, 50);
    std::fill_n(expected.begin(), 20, 0);
    EXPECT_EQ(partnersOf(first, second, {AlignBy::Sample, 0}), expected);
}

TEST(AlignmentTest, BeginningsAlignWhatHasNothingInCommon) {
    Recording first;
    Recording second;
    auto other = Recording::settings();
    other.firstSample = 700;
    other.startTimeOfDayMs = 1'000;
    first.perform(Recording::settings(), 0, 40);
    second.perform(other, 0, 50);
    EXPECT_EQ(naturalAlignment(*first.timetable(), *second.timetable()), AlignBy::Begin);
    EXPECT_EQ(partnersOf(first, second, {AlignBy::Begin, 0}), from(700, 40));
}

TEST(AlignmentTest, AnOffsetMovesByWholeSamples) {
    Recording first;
    Recording second;
    first.perform(Recording::settings(240), 0, 100);
    second.perform(Recording::settings(240), 0, 200);
    for (const AlignBy by : {AlignBy::TimeCode, AlignBy::Sample, AlignBy::Begin}) {
        const double step = stepOf(by, *second.timetable());
        EXPECT_EQ(partnersOf(first, second, {by, 7 * step}), from(8, 100)) << static_cast<int>(by);
        EXPECT_EQ(partnersOf(first, second, {by, -step})[0], 0U) << static_cast<int>(by);
    }
}

TEST(AlignmentTest, OfTwoRatesOnlySamplesOfTheSameMomentBelongTogether) {
    Recording slow;
    Recording fast;
    slow.perform(Recording::settings(60), 0, 30);
    fast.perform(Recording::settings(240), 0, 120);
    const auto partners = partnersOf(slow, fast, {AlignBy::TimeCode, 0});
    for (std::size_t i = 0; i < partners.size(); ++i) {
        EXPECT_EQ(partners[i], 1 + 4 * i);
    }
    const auto back = partnersOf(fast, slow, {AlignBy::Begin, 0});
    EXPECT_EQ(std::ranges::count(back, 0U), 90);
}

TEST(AlignmentTest, AGapHasNoPartner) {
    Recording first;
    Recording second;
    first.perform(Recording::settings(), 0, 20);
    second.perform(Recording::settings(), 0, 20,
                   [](const wire::Datagram& datagram) { return datagram.header.sampleCounter != 10; });
    auto expected = from(1, 20);
    expected[9] = 0;
    EXPECT_EQ(partnersOf(first, second, {AlignBy::TimeCode, 0}), expected);
    EXPECT_TRUE(Partners(first.timetable(), second.timetable(), {AlignBy::TimeCode, 0})
                    .isCommon(first.timetable()->samples()[9]));
}

TEST(AlignmentTest, WhatIsPlayedTwiceFindsTheSamePartnersTwice) {
    Recording first;
    Recording second;
    constexpr std::size_t kFrames = 700;
    first.perform(Recording::settings(), 0, kFrames);
    first.perform(Recording::settings(), 0, kFrames);
    second.perform(Recording::settings(), 0, kFrames);
    auto expected = from(1, kFrames);
    const auto again = expected;
    expected.insert(expected.end(), again.begin(), again.end());
    EXPECT_EQ(partnersOf(first, second, {AlignBy::TimeCode, 0}), expected);
}

TEST(AlignmentTest, NothingHasNoPartners) {
    Recording first;
    const Recording nothing;
    first.perform(Recording::settings(), 0, 10);
    EXPECT_EQ(naturalAlignment(*first.timetable(), *nothing.timetable()), AlignBy::Begin);
    EXPECT_EQ(partnersOf(first, nothing, {AlignBy::Begin, 0}), std::vector<std::uint32_t>(10));
    EXPECT_FALSE(Partners(first.timetable(), nothing.timetable(), {}).isCommon({}));
}

TEST(AlignmentTest, CharactersPairByNameThenByIdThenInOrder) {
    Recording first;
    Recording second;
    auto two = Recording::settings();
    two.characters = 2;
    first.perform(two, 0, 2);
    second.perform(two, 0, 2, [](wire::Datagram& datagram) { // the same two, numbered the other way
        datagram.header.character = static_cast<std::uint8_t>(1 - datagram.header.character);
        return true;
    });
    auto pairs = pairCharacters(first.session, second.session);
    ASSERT_EQ(pairs.size(), 2U);
    EXPECT_EQ(pairs[0].first.character, 0);
    EXPECT_EQ(pairs[0].second.character, 1);

    Recording nameless;
    nameless.perform(two, 0, 2, [](wire::Datagram& datagram) { return datagram.header.type() == 2; });
    pairs = pairCharacters(first.session, nameless.session);
    ASSERT_EQ(pairs.size(), 2U);
    EXPECT_EQ(pairs[0].second.character, 0);

    Recording other;
    other.perform(Recording::settings(), 0, 2, [](wire::Datagram& datagram) {
        datagram.header.character = 9;
        return datagram.header.type() == 2;
    });
    pairs = pairCharacters(first.session, other.session);
    ASSERT_EQ(pairs.size(), 1U);
    EXPECT_EQ(pairs[0].second.character, 9);
}

} // namespace
} // namespace posewire::exporting
