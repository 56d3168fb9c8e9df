// SPDX-License-Identifier: MIT
#include "tests/core/performer/receiving.h"

#include "core/log/tcp_framer.h"
#include "core/performer/truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

/// What a sender did on purpose against what a receiver counts, one fault at a time and some together.
namespace posewire::performer {
namespace {

PerformerSettings streamOf(std::uint8_t type = 24) {
    PerformerSettings settings;
    settings.characters = 1;
    settings.types = {type};
    settings.motion = "tpose";
    settings.firstSample = 500;
    return settings;
}

/// A faulty stream of five seconds: what was done to it, what left, and what a receiver counts.
struct Outcome {
    FaultTally tally;
    std::vector<Sending> sendings;
    Received received;
    SentFigures counts;
};

Outcome outcomeOf(const FaultSettings& faults, const PerformerSettings& performance = streamOf()) {
    Outcome outcome;
    outcome.sendings = performWithFaults(performance, faults, 5.0, &outcome.tally);
    outcome.received = receiveAll(outcome.sendings);
    const std::uint8_t type = performance.types.front();
    const auto found = outcome.received.streams.find({0, type});
    outcome.counts =
        found == outcome.received.streams.end() ? SentFigures{} : figuresOf(found->second.counts(), type);
    // Nothing comes from nowhere and nothing goes without being counted.
    EXPECT_EQ(outcome.sendings.size(),
              outcome.tally.offered - outcome.tally.dropped + outcome.tally.duplicated);
    return outcome;
}

constexpr std::uint64_t kSamples = 1'200;

class OneFault : public testing::TestWithParam<std::uint64_t> {
protected:
    static FaultSettings with(const std::function<void(FaultSettings&)>& set) {
        FaultSettings settings;
        settings.seed = GetParam();
        set(settings);
        return settings;
    }
};

TEST_P(OneFault, DroppedOnesAreTheLostOnesBetweenTheFirstAndTheLast) {
    const Outcome outcome = outcomeOf(with([](FaultSettings& settings) { settings.drop = 0.1; }));
    EXPECT_EQ(outcome.tally.offered, kSamples);
    EXPECT_EQ(outcome.counts.samples, kSamples - outcome.tally.dropped);
    const std::uint64_t atTheEnds = kSamples - 1 - (outcome.counts.lastSample - outcome.counts.firstSample);
    EXPECT_EQ(outcome.counts.lost + atTheEnds, outcome.tally.dropped);
    EXPECT_GT(outcome.tally.dropped, 60U);
    EXPECT_EQ(outcome.counts.duplicates + outcome.counts.reordered + outcome.counts.restarts, 0U);
}

TEST_P(OneFault, DuplicatedOnesAreTheDuplicates) {
    const Outcome outcome = outcomeOf(with([](FaultSettings& settings) { settings.duplicate = 0.1; }));
    EXPECT_EQ(outcome.counts.duplicates, outcome.tally.duplicated);
    EXPECT_EQ(outcome.counts.samples, kSamples);
    EXPECT_EQ(outcome.counts.datagrams, kSamples + outcome.tally.duplicated);
    EXPECT_GT(outcome.tally.duplicated, 60U);
    EXPECT_EQ(outcome.counts.lost + outcome.counts.reordered + outcome.counts.restarts, 0U);
}

TEST_P(OneFault, ReorderedOnesAreNoMoreThanThoseHeldBack) {
    const Outcome outcome = outcomeOf(with([](FaultSettings& settings) { settings.reorder = 0.05; }));
    EXPECT_LE(outcome.counts.reordered, outcome.tally.reordered);
    EXPECT_GT(outcome.counts.reordered, outcome.tally.reordered / 2);
    EXPECT_LE(outcome.counts.late, outcome.counts.reordered);
    EXPECT_EQ(outcome.counts.samples + outcome.tally.dropped, kSamples);
    EXPECT_EQ(outcome.counts.duplicates + outcome.counts.restarts, 0U);
}

TEST_P(OneFault, TruncatedOnesCannotBeDecodedAndAreLost) {
    const Outcome outcome =
        outcomeOf(with([](FaultSettings& settings) { settings.truncate = 0.1; }), streamOf(2));
    EXPECT_EQ(outcome.received.sender.malformed + outcome.received.sender.foreign, outcome.tally.truncated);
    EXPECT_EQ(outcome.counts.samples, kSamples - outcome.tally.truncated);
    EXPECT_GT(outcome.tally.truncated, 60U);
    EXPECT_EQ(outcome.counts.incomplete + outcome.counts.restarts, 0U);
}

TEST_P(OneFault, CorruptedOnesAreMalformedForeignOrStillADatagram) {
    const Outcome outcome =
        outcomeOf(with([](FaultSettings& settings) { settings.corrupt = 0.1; }), streamOf(2));
    const SenderFigures& sender = outcome.received.sender;
    EXPECT_EQ(sender.datagrams + sender.malformed + sender.foreign, kSamples);
    EXPECT_LE(sender.malformed + sender.foreign, outcome.tally.corrupted);
    EXPECT_GE(sender.datagrams, kSamples - outcome.tally.corrupted);
    EXPECT_GT(sender.malformed, 0U);
    EXPECT_EQ(outcome.counts.restarts, 0U);
}

TEST_P(OneFault, WithheldOnesOfAPauseAreLost) {
    const Outcome outcome = outcomeOf(with([](FaultSettings& settings) {
        settings.pause = FaultSettings::Pause{2.0, 1.5};
    }));
    EXPECT_EQ(outcome.tally.withheld, 360U) << "1.5 s at 240 Hz";
    EXPECT_EQ(outcome.counts.lost, outcome.tally.withheld);
    EXPECT_EQ(outcome.counts.samples, kSamples - outcome.tally.withheld);
    EXPECT_EQ(outcome.counts.restarts, 0U);
}

TEST_P(OneFault, WithheldOnesOfAReducedRateAreNotLost) {
    for (const std::uint32_t step : {2U, 3U, 5U}) {
        const Outcome outcome = outcomeOf(with([step](FaultSettings& settings) {
            settings.reduction = FaultSettings::Reduction{1.0, step};
        }));
        EXPECT_EQ(outcome.counts.lost, 0U);
        EXPECT_EQ(outcome.counts.step, step);
        EXPECT_EQ(outcome.counts.samples, kSamples - outcome.tally.withheld);
        EXPECT_NEAR(static_cast<double>(outcome.tally.withheld), 960.0 * (step - 1) / step, 1.0);
    }
}

TEST_P(OneFault, RestartsAreCountedOnceWhereverTheCounterGoes) {
    for (const std::uint32_t first : {1U, 100'000U, 0xfffffff0U}) {
        const Outcome outcome = outcomeOf(with([first](FaultSettings& settings) {
            settings.restart = FaultSettings::Restart{2.5, first};
        }));
        EXPECT_EQ(outcome.counts.restarts, 1U) << first;
        EXPECT_EQ(outcome.counts.lost + outcome.counts.duplicates, 0U) << first;
        EXPECT_EQ(outcome.counts.samples, kSamples) << first;
        EXPECT_EQ(outcome.counts.lastSample, first + 599) << first;
    }
}

TEST_P(OneFault, SplitSamplesAreWholeUntilAPartIsDropped) {
    FaultSettings faults = with([](FaultSettings& settings) { settings.splits = true; });
    const Outcome whole = outcomeOf(faults, streamOf(2));
    EXPECT_EQ(whole.counts.samples, kSamples);
    EXPECT_EQ(whole.counts.incomplete, 0U);
    EXPECT_GT(whole.tally.offered, 2 * kSamples - 1);
    faults.drop = 0.05;
    const Outcome cut = outcomeOf(faults, streamOf(2));
    EXPECT_GT(cut.counts.incomplete, 0U);
    const std::uint64_t atTheEnds = kSamples - 1 - (cut.counts.lastSample - cut.counts.firstSample);
    EXPECT_EQ(cut.counts.samples + cut.counts.incomplete + cut.counts.lost + atTheEnds, kSamples);
    EXPECT_EQ(cut.counts.datagrams, cut.tally.offered - cut.tally.dropped);
}

TEST_P(OneFault, NoneOfThemTogetherLosesCount) {
    Outcome outcome = outcomeOf(with([](FaultSettings& settings) {
                                    settings.drop = settings.duplicate = settings.reorder =
                                        settings.truncate = 0.05;
                                    settings.jitterMs = 15;
                                }),
                                streamOf(2));
    const SenderFigures& sender = outcome.received.sender;
    EXPECT_EQ(sender.datagrams + sender.malformed + sender.foreign, outcome.sendings.size());
    EXPECT_EQ(outcome.counts.datagrams, sender.datagrams);
    EXPECT_EQ(outcome.counts.samples + outcome.counts.duplicates, outcome.counts.datagrams);
    EXPECT_EQ(outcome.counts.samples + outcome.counts.lost,
              outcome.counts.lastSample - outcome.counts.firstSample + std::uint64_t{1});
    EXPECT_EQ(outcome.counts.restarts, 0U);
}

INSTANTIATE_TEST_SUITE_P(Seeds, OneFault, testing::Values(1, 2, 77));

/// What a TCP receiver counts that reads the stream in pieces of any size.
SenderFigures streamed(const std::vector<Sending>& sendings, std::size_t atMost, std::uint64_t& skipped) {
    std::vector<std::byte> stream;
    for (const Sending& sending : sendings) {
        stream.insert(stream.end(), sending.bytes.begin(), sending.bytes.end());
    }
    SenderFigures figures;
    log::TcpFramer framer;
    const auto visit = [&](const log::TcpFramer::Piece& piece) {
        if (piece.kind == log::TcpFramer::Kind::Datagram) {
            figures.bytes += piece.bytes.size();
            ++(wire::decode(piece.bytes) ? figures.datagrams : figures.malformed);
        }
    };
    for (std::size_t place = 0; place < stream.size(); place += atMost) {
        framer.push(std::span(stream).subspan(place, std::min(atMost, stream.size() - place)), visit);
    }
    framer.finish(visit);
    skipped = framer.skippedBytes();
    return figures;
}

TEST(StreamedTruth, IsWhatAReceiverOfTheByteStreamCounts) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        FaultSettings faults;
        faults.seed = seed;
        faults.truncate = seed % 2 == 0 ? 0.05 : 0.0;
        faults.corrupt = seed > 2 ? 0.05 : 0.0;
        faults.drop = 0.02;
        const auto sendings = performWithFaults(streamOf(2), faults, 2.0);
        StreamedTruth truth;
        for (const Sending& sending : sendings) {
            truth.add(sending);
        }
        truth.finish();
        for (const std::size_t atMost : {37U, 760U, 5'000U}) {
            std::uint64_t skipped = 0;
            const SenderFigures received = streamed(sendings, atMost, skipped);
            EXPECT_EQ(received, truth.truth().sender()) << "seed " << seed << ", pieces of " << atMost;
            EXPECT_EQ(skipped, truth.skippedBytes());
        }
    }
}

TEST(FaultSettings, TakeProbabilitiesFromZeroToOne) {
    constexpr std::array members{&FaultSettings::drop, &FaultSettings::duplicate, &FaultSettings::reorder,
                                 &FaultSettings::corrupt, &FaultSettings::truncate};
    for (const auto member : members) {
        for (const double value : {0.0, 0.5, 1.0}) {
            FaultSettings settings;
            settings.*member = value;
            EXPECT_EQ(findProblem(settings), std::nullopt);
        }
        for (const double value :
             {-1e-9, 1.0 + 1e-9, std::nan(""), std::numeric_limits<double>::infinity()}) {
            FaultSettings settings;
            settings.*member = value;
            EXPECT_TRUE(findProblem(settings).has_value()) << value;
        }
    }
}

TEST(FaultSettings, HaveBoundsThatBelongToThem) {
    const auto isFine = [](const std::function<void(FaultSettings&)>& set) {
        FaultSettings settings;
        set(settings);
        return !findProblem(settings);
    };
    EXPECT_TRUE(isFine([](auto& settings) { settings.burst = 1'000'000; }));
    EXPECT_FALSE(isFine([](auto& settings) { settings.burst = 1'000'001; }));
    EXPECT_FALSE(isFine([](auto& settings) { settings.burst = -1; }));
    EXPECT_TRUE(isFine([](auto& settings) { settings.delayMs = settings.jitterMs = 10'000; }));
    EXPECT_FALSE(isFine([](auto& settings) { settings.delayMs = 10'000.1; }));
    EXPECT_FALSE(isFine([](auto& settings) { settings.jitterMs = std::nan(""); }));
    EXPECT_TRUE(isFine([](auto& settings) { settings.reduction = {0.0, 100}; }));
    EXPECT_FALSE(isFine([](auto& settings) { settings.reduction = {0.0, 101}; }));
    EXPECT_FALSE(isFine([](auto& settings) { settings.reduction = {-1.0, 2}; }));
    EXPECT_TRUE(isFine([](auto& settings) { settings.pause = {0.0, 0.0}; }));
    EXPECT_FALSE(isFine([](auto& settings) { settings.pause = {1.0, -0.1}; }));
    EXPECT_FALSE(isFine([](auto& settings) { settings.pause = {std::nan(""), 1.0}; }));
    EXPECT_TRUE(isFine([](auto& settings) { settings.restart = {0.0, 0}; }));
    EXPECT_FALSE(isFine([](auto& settings) { settings.restart = {-0.001, 1}; }));
}

} // namespace
} // namespace posewire::performer
