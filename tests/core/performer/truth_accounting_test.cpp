// SPDX-License-Identifier: MIT
#include "tests/core/performer/receiving.h"

#include <gtest/gtest.h>

#include <ostream>

/// The sender knows what it sent; the accounting sees only what arrives. Both must say the same.
namespace posewire::performer {

std::ostream& operator<<(std::ostream& out, const SentFigures& figures) {
    return out << "datagrams " << figures.datagrams << " samples " << figures.samples << " lost "
               << figures.lost << " duplicates " << figures.duplicates << " reordered " << figures.reordered
               << " late " << figures.late << " incomplete " << figures.incomplete << " restarts "
               << figures.restarts << " step " << figures.step << " first " << figures.firstSample << " last "
               << figures.lastSample;
}

namespace {

void expectAgreement(const PerformerSettings& performance, const FaultSettings& faults, double seconds) {
    const auto sendings = performWithFaults(performance, faults, seconds);
    const Truth truth = truthOf(sendings);
    const Received received = receiveAll(sendings);
    EXPECT_EQ(received.sender, truth.sender());
    EXPECT_EQ(received.streams.size(), truth.streams().size());
    for (const auto& [key, stream] : truth.streams()) {
        const auto found = received.streams.find(key);
        ASSERT_NE(found, received.streams.end());
        EXPECT_EQ(figuresOf(found->second.counts(), key.type), stream.figures())
            << "character " << int(key.character) << ", type " << int(key.type);
    }
}

PerformerSettings everything(std::uint64_t seed) {
    PerformerSettings settings;
    settings.characters = 4;
    settings.seed = seed;
    settings.motion = "tpose";
    return settings;
}

/// All kinds mixed, other shares with every seed.
FaultSettings mixture(std::uint64_t seed) {
    const KeyedRandom random(seed * 977);
    FaultSettings settings;
    settings.seed = seed;
    if (seed % 3 == 0) {
        settings.gilbertElliott = GilbertElliott{random.uniform(1, 0.0, 0.01), random.uniform(2, 0.05, 0.5)};
    } else {
        settings.drop = random.uniform(1, 0.0, 0.08);
        settings.burst = seed % 3 == 1 ? 1 : 1 + static_cast<int>(random.bits(2) % 90);
    }
    settings.duplicate = random.uniform(3, 0.0, 0.08);
    settings.reorder = random.uniform(4, 0.0, 0.08);
    settings.corrupt = random.uniform(5, 0.0, 0.03);
    settings.truncate = random.uniform(6, 0.0, 0.03);
    settings.delayMs = random.uniform(7, 0.0, 30.0);
    settings.jitterMs = seed % 4 == 1 ? random.uniform(8, 0.0, 30.0) : 0.0;
    settings.splits = seed % 2 == 0;
    if (seed % 5 == 1 || seed % 5 == 3) {
        settings.restart = FaultSettings::Restart{random.uniform(9, 0.7, 1.2), 1};
    }
    if (seed % 5 == 3 || seed % 5 == 2) {
        settings.pause = FaultSettings::Pause{random.uniform(10, 1.4, 1.6), random.uniform(11, 0.01, 0.3)};
    }
    if (seed % 5 == 4 || seed % 5 == 2) {
        settings.reduction =
            FaultSettings::Reduction{random.uniform(12, 0.7, 1.2), static_cast<std::uint32_t>(2 + seed % 3)};
    }
    return settings;
}

class TruthAndAccounting : public testing::TestWithParam<int> {};

TEST_P(TruthAndAccounting, AgreeOnAllKindsMixed) {
    const auto seed = static_cast<std::uint64_t>(GetParam());
    PerformerSettings performance = everything(seed);
    performance.firstSample = seed % 4 == 0 ? 0xffffff80U + static_cast<std::uint32_t>(seed) : 1000;
    expectAgreement(performance, mixture(seed), 2.5);
}

INSTANTIATE_TEST_SUITE_P(Seeds, TruthAndAccounting, testing::Range(1, 41));

TEST(TruthAndAccountingOf, OneStreamAtEveryRate) {
    for (const double rateHz : {10.0, 60.0, 100.0, 1000.0}) {
        for (std::uint64_t seed = 1; seed <= 8; ++seed) {
            SCOPED_TRACE(testing::Message() << rateHz << " Hz, seed " << seed);
            PerformerSettings performance = everything(seed);
            performance.characters = 1;
            performance.types = {2, 13, 24, 25};
            performance.rateHz = rateHz;
            FaultSettings faults = mixture(seed);
            faults.restart.reset();
            faults.reduction.reset();
            expectAgreement(performance, faults, 1000.0 / rateHz);
        }
    }
}

} // namespace
} // namespace posewire::performer
