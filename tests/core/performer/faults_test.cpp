// SPDX-License-Identifier: MIT
#include "tests/core/performer/faulty_performance.h"

#include "core/performer/sending.h"
#include "core/wire/type_table.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <optional>
#include <set>

namespace posewire::performer {
namespace {

using namespace std::chrono_literals;

PerformerSettings oneStream(double rateHz = 240.0) {
    PerformerSettings settings;
    settings.characters = 1;
    settings.types = {24};
    settings.rateHz = rateHz;
    return settings;
}

wire::Header headerOf(const Sending& sending) {
    return wire::decodeHeader(sending.bytes).value_or(wire::Header{});
}

std::vector<std::uint32_t> samplesOf(const std::vector<Sending>& sendings) {
    std::vector<std::uint32_t> samples;
    for (const Sending& sending : sendings) {
        samples.push_back(headerOf(sending).sampleCounter);
    }
    return samples;
}

SentFigures sentFiguresOf(const std::vector<Sending>& sendings, std::uint8_t type = 24) {
    const Truth truth = truthOf(sendings);
    const auto found = truth.streams().find({0, type});
    return found == truth.streams().end() ? SentFigures{} : found->second.figures();
}

TEST(Faults, LeaveEverythingAloneWithoutSettings) {
    PerformerSettings settings;
    const auto sendings = performWithFaults(settings, {}, 2.0);
    Performer performer(settings);
    std::size_t place = 0;
    for (std::uint64_t index = 0; index < 480; ++index) {
        for (const wire::Datagram& datagram : performer.frame(index)) {
            ASSERT_LT(place, sendings.size());
            EXPECT_EQ(sendings[place].bytes, *wire::encode(datagram));
            EXPECT_EQ(sendings[place].due,
                      log::Duration(static_cast<std::int64_t>(static_cast<double>(index) * 1e9 / 240.0)));
            ++place;
        }
    }
    EXPECT_EQ(place, sendings.size());
}

TEST(Faults, GiveTheSameForTheSameSeed) {
    FaultSettings settings;
    settings.drop = settings.duplicate = settings.reorder = settings.corrupt = settings.truncate = 0.05;
    settings.jitterMs = 10.0;
    settings.splits = true;
    const auto first = performWithFaults({}, settings, 1.0);
    const auto second = performWithFaults({}, settings, 1.0);
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t place = 0; place < first.size(); ++place) {
        ASSERT_EQ(first[place].bytes, second[place].bytes);
        ASSERT_EQ(first[place].due, second[place].due);
    }
    settings.seed = 2;
    EXPECT_NE(samplesOf(performWithFaults({}, settings, 1.0)), samplesOf(first));
}

TEST(Faults, LeaveInTheOrderOfTheirTimes) {
    FaultSettings settings;
    settings.reorder = settings.duplicate = 0.2;
    settings.jitterMs = 60.0;
    const auto sendings = performWithFaults({}, settings, 2.0);
    EXPECT_TRUE(std::ranges::is_sorted(sendings, {}, &Sending::due));
}

TEST(Faults, DropTheShareThatWasAskedForInBurstsOfThatLength) {
    for (const int burst : {1, 5, 20}) {
        FaultSettings settings;
        settings.drop = 0.2;
        settings.burst = burst;
        const auto samples = samplesOf(performWithFaults(oneStream(), settings, 100.0));
        EXPECT_NEAR(static_cast<double>(samples.size()) / 24'000.0, 0.8, 0.03) << burst;
        std::size_t gaps = 0;
        for (std::size_t place = 1; place < samples.size(); ++place) {
            const auto lost = samples[place] - samples[place - 1] - 1;
            gaps += lost > 0 ? 1 : 0;
            EXPECT_EQ(lost % static_cast<std::uint32_t>(burst), 0U);
        }
        EXPECT_NEAR(static_cast<double>(gaps) * burst / 24'000.0, 0.2, burst == 1 ? 0.06 : 0.05);
    }
}

TEST(Faults, LoseAfterGilbertAndElliott) {
    FaultSettings settings;
    settings.gilbertElliott = GilbertElliott{0.02, 0.2, 1.0, 0.0};
    const auto samples = samplesOf(performWithFaults(oneStream(), settings, 200.0));
    // Stationary share of the bad state: p / (p + r); its mean length: 1 / r.
    EXPECT_NEAR(static_cast<double>(samples.size()) / 48'000.0, 1.0 - 0.02 / 0.22, 0.01);
    double gaps = 0.0;
    for (std::size_t place = 1; place < samples.size(); ++place) {
        gaps += samples[place] - samples[place - 1] > 1 ? 1.0 : 0.0;
    }
    EXPECT_NEAR((48'000.0 - static_cast<double>(samples.size())) / gaps, 5.0, 0.5);
}

TEST(Faults, DuplicateAtOnceAndLater) {
    FaultSettings settings;
    settings.duplicate = 0.3;
    const auto sendings = performWithFaults(oneStream(), settings, 10.0);
    const SentFigures figures = sentFiguresOf(sendings);
    EXPECT_EQ(figures.samples, 2400U);
    EXPECT_EQ(figures.datagrams, sendings.size());
    EXPECT_EQ(figures.duplicates, sendings.size() - 2400U);
    EXPECT_NEAR(static_cast<double>(figures.duplicates), 720.0, 80.0);
    EXPECT_EQ(figures.reordered, 0U);
    EXPECT_EQ(figures.lost, 0U);
}

TEST(Faults, ReorderByLittleByMuchAndByMoreThanAHundredSamples) {
    FaultSettings settings;
    settings.reorder = 0.1;
    const auto samples = samplesOf(performWithFaults(oneStream(), settings, 20.0));
    std::uint32_t highest = 0;
    std::uint32_t most = 0;
    std::size_t few = 0;
    for (const std::uint32_t sample : samples) {
        highest = std::max(highest, sample);
        most = std::max(most, highest - sample);
        few += highest != sample && highest - sample < 10 ? 1 : 0;
    }
    EXPECT_GT(most, 100U);
    EXPECT_GT(few, 100U);
    const SentFigures figures = sentFiguresOf(performWithFaults(oneStream(), settings, 20.0));
    EXPECT_GT(figures.reordered, 200U);
    EXPECT_GT(figures.late, 50U);
    EXPECT_EQ(figures.restarts, 0U);
}

TEST(Faults, NeverComeBehindByATimeThatIsLateOnlyPerhaps) {
    for (const double rateHz : {240.0, 60.0, 10.0}) {
        FaultSettings settings;
        settings.reorder = 0.2;
        settings.jitterMs = 80.0;
        std::int64_t highest = 0;
        std::vector<std::optional<log::Duration>> overtaken(10'000);
        for (const Sending& sending : performWithFaults(oneStream(rateHz), settings, 15.0)) {
            const std::int64_t sample = headerOf(sending).sampleCounter;
            for (; highest < sample; ++highest) {
                overtaken[static_cast<std::size_t>(highest)] = sending.due;
            }
            const auto since = overtaken[static_cast<std::size_t>(sample)];
            if (sample < highest && since) {
                const std::int64_t lateMs = (sending.due - *since) / 1ms;
                EXPECT_TRUE(lateMs <= 25 || lateMs >= 99)
                    << rateHz << " Hz, sample " << sample << ": " << lateMs;
            }
        }
    }
}

TEST(Faults, NeverLookLikeARestartThatIsNone) {
    FaultSettings settings;
    settings.reorder = 0.5;
    settings.duplicate = 0.2;
    std::uint32_t highest = 0;
    bool wasFar = false;
    for (const std::uint32_t sample : samplesOf(performWithFaults(oneStream(), settings, 20.0))) {
        const bool isFar = sample + 100 < highest;
        EXPECT_FALSE(isFar && wasFar) << sample;
        wasFar = isFar;
        highest = std::max(highest, sample);
    }
}

TEST(Faults, DelayEverythingAlikeWithoutJitter) {
    FaultSettings settings;
    settings.delayMs = 40.0;
    const auto sendings = performWithFaults(oneStream(), settings, 1.0);
    ASSERT_EQ(sendings.size(), 240U);
    EXPECT_EQ(sendings.front().due, 40ms);
    EXPECT_TRUE(std::ranges::is_sorted(samplesOf(sendings)));
}

TEST(Faults, SplitEverySampleOfSeveralItems) {
    PerformerSettings performance;
    performance.characters = 1;
    FaultSettings settings;
    settings.splits = true;
    const auto sendings = performWithFaults(performance, settings, 1.0);
    for (const Sending& sending : sendings) {
        const auto datagram = wire::decode(sending.bytes);
        ASSERT_TRUE(datagram.has_value());
        EXPECT_TRUE(datagram->notices.empty()) << int(datagram->header.type());
    }
    const Truth truth = truthOf(sendings);
    for (const auto& [key, stream] : truth.streams()) {
        const SentFigures figures = stream.figures();
        if (wire::isSampled(key.type)) {
            EXPECT_EQ(figures.samples, 240U) << int(key.type);
            EXPECT_EQ(figures.datagrams > 480U, key.type != 24 && key.type != 25) << int(key.type);
        }
        EXPECT_EQ(figures.incomplete + figures.lost + figures.duplicates + figures.reordered, 0U);
    }
}

TEST(Faults, CountSamplesWithMissingPartsAsIncomplete) {
    PerformerSettings performance = oneStream();
    performance.types = {2};
    FaultSettings settings;
    settings.splits = true;
    settings.drop = 0.1;
    const SentFigures figures = sentFiguresOf(performWithFaults(performance, settings, 10.0), 2);
    EXPECT_GT(figures.incomplete, 300U);
    EXPECT_GT(figures.lost, 1U);
    EXPECT_EQ((figures.lastSample - figures.firstSample) + 1U,
              figures.samples + figures.incomplete + figures.lost);
}

TEST(Faults, CutAndCorruptIntoWhatTheCodecRejectsOrAccepts) {
    FaultSettings settings;
    settings.corrupt = 0.2;
    settings.truncate = 0.2;
    FaultTally tally;
    const auto sendings = performWithFaults({}, settings, 2.0, &tally);
    const SenderFigures sender = truthOf(sendings).sender();
    EXPECT_NEAR(static_cast<double>(tally.truncated), 0.2 * static_cast<double>(tally.offered), 400.0);
    EXPECT_GT(sender.malformed, tally.truncated / 2);
    EXPECT_GT(sender.foreign, 10U);
    EXPECT_EQ(sender.datagrams + sender.malformed + sender.foreign, sendings.size());
    EXPECT_EQ(sendings.size() + tally.dropped, tally.offered + tally.duplicated);
}

TEST(Faults, RestartTheCounterWithoutLoss) {
    PerformerSettings performance = oneStream();
    performance.firstSample = 500;
    FaultSettings settings;
    settings.restart = FaultSettings::Restart{2.0, 7};
    const auto sendings = performWithFaults(performance, settings, 5.0);
    const auto samples = samplesOf(sendings);
    EXPECT_EQ(samples[479], 979U);
    EXPECT_EQ(samples[480], 7U);
    const SentFigures expected{
        .datagrams = 1200, .samples = 1200, .restarts = 1, .step = 1, .firstSample = 500, .lastSample = 726};
    EXPECT_EQ(sentFiguresOf(sendings), expected);
}

TEST(Faults, TakeARestartByAFewSamplesForTheRepetitionThatItIs) {
    FaultSettings settings;
    settings.restart = FaultSettings::Restart{0.25, 1};
    const SentFigures expected{
        .datagrams = 240, .samples = 180, .duplicates = 60, .step = 1, .firstSample = 1, .lastSample = 180};
    EXPECT_EQ(sentFiguresOf(performWithFaults(oneStream(), settings, 1.0)), expected);
}

TEST(Faults, PauseWhileTheCounterGoesOn) {
    FaultSettings settings;
    settings.pause = FaultSettings::Pause{1.0, 0.5};
    const SentFigures expected{
        .datagrams = 360, .samples = 360, .lost = 120, .step = 1, .firstSample = 1, .lastSample = 480};
    EXPECT_EQ(sentFiguresOf(performWithFaults(oneStream(), settings, 2.0)), expected);
    settings.pause = FaultSettings::Pause{1.0, 20.0};
    const SentFigures restarted{
        .datagrams = 480, .samples = 480, .restarts = 1, .step = 1, .firstSample = 1, .lastSample = 5280};
    EXPECT_EQ(sentFiguresOf(performWithFaults(oneStream(), settings, 22.0)), restarted);
}

TEST(Faults, ReduceTheRateWithoutLoss) {
    FaultSettings settings;
    settings.reduction = FaultSettings::Reduction{1.0, 4};
    const auto sendings = performWithFaults(oneStream(), settings, 2.0);
    const SentFigures expected{
        .datagrams = 300, .samples = 300, .step = 4, .firstSample = 1, .lastSample = 477};
    EXPECT_EQ(sentFiguresOf(sendings), expected);
}

TEST(Faults, CountThroughTheWrapAroundOfTheCounter) {
    PerformerSettings performance = oneStream();
    performance.firstSample = 0xffffff00U;
    FaultSettings settings;
    settings.drop = 0.1;
    const SentFigures figures = sentFiguresOf(performWithFaults(performance, settings, 4.0));
    EXPECT_EQ(figures.restarts, 0U);
    EXPECT_EQ(figures.samples + figures.lost, figures.lastSample - figures.firstSample + 1U);
    EXPECT_LT(figures.lastSample, 1000U);
}

TEST(Faults, LeaveMessagesOfCharacterInformationOutOfSampleAccounting) {
    PerformerSettings performance = oneStream();
    performance.types = {12, 13};
    FaultSettings settings;
    settings.drop = 0.15;
    const SentFigures scale = sentFiguresOf(performWithFaults(performance, settings, 60.0), 13);
    EXPECT_GT(scale.incomplete, 3U);
    EXPECT_EQ(scale.samples + scale.lost + scale.duplicates + scale.step, 0U);
}

TEST(Faults, SayWhatIsWrongWithSettings) {
    EXPECT_EQ(findProblem(FaultSettings{}), std::nullopt);
    FaultSettings settings;
    settings.drop = 1.5;
    EXPECT_THAT(*findProblem(settings), testing::HasSubstr("drop"));
    settings = {};
    settings.burst = 0;
    EXPECT_TRUE(findProblem(settings).has_value());
    settings = {};
    settings.gilbertElliott = GilbertElliott{0.1, 2.0, 1.0, 0.0};
    EXPECT_TRUE(findProblem(settings).has_value());
    settings.gilbertElliott = GilbertElliott{};
    settings.drop = 0.1;
    EXPECT_TRUE(findProblem(settings).has_value());
    settings = {};
    settings.jitterMs = -1.0;
    EXPECT_TRUE(findProblem(settings).has_value());
    settings = {};
    settings.reduction = FaultSettings::Reduction{1.0, 0};
    EXPECT_TRUE(findProblem(settings).has_value());
}

TEST(SampleSplit, DividesItemsInTheirOrder) {
    PerformerSettings settings = oneStream();
    settings.types = {2};
    const wire::Datagram whole = Performer(settings).frame(0).front();
    const auto parts = splitSample(*wire::encode(whole), 4);
    ASSERT_EQ(parts.size(), 4U);
    std::vector<wire::SegmentQuaternion> segments;
    for (std::size_t place = 0; place < parts.size(); ++place) {
        const auto part = wire::decode(parts[place]);
        ASSERT_TRUE(part.has_value());
        EXPECT_EQ(part->header.datagramIndex(), place);
        EXPECT_EQ(part->header.isLast(), place == 3);
        EXPECT_EQ(part->header.sampleCounter, whole.header.sampleCounter);
        const auto& items = std::get<wire::PoseQuaternion>(part->body).segments;
        EXPECT_EQ(part->header.items, items.size());
        segments.insert(segments.end(), items.begin(), items.end());
    }
    EXPECT_EQ(segments, std::get<wire::PoseQuaternion>(whole.body).segments);
}

TEST(SampleSplit, LeavesWhatCannotBeDivided) {
    Performer performer({});
    for (const wire::Datagram& datagram : performer.frame(0)) {
        const auto bytes = *wire::encode(datagram);
        const auto parts = splitSample(bytes, 3);
        const auto type = datagram.header.type();
        const bool isDivided = wire::isSampled(type) && type != 24 && type != 25;
        EXPECT_EQ(parts.size(), isDivided ? 3U : 1U) << int(type);
        EXPECT_TRUE(isDivided || parts.front() == bytes);
    }
    const std::vector<std::byte> rubbish(10, std::byte{1});
    EXPECT_EQ(splitSample(rubbish, 3), (std::vector<std::vector<std::byte>>{rubbish}));
}

} // namespace
} // namespace posewire::performer
