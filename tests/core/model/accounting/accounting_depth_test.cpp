// SPDX-License-Identifier: MIT
#include "core/model/accounting/stream_accounting.h"

#include <gtest/gtest.h>

#include <random>

namespace posewire::model {
namespace {

using namespace std::chrono_literals;

/// A stream of some faults, told to as many accountings as a test likes.
class FaultyStream {
public:
    explicit FaultyStream(std::uint32_t seed) : m_random(seed) {}

    template <class... Accountings>
    void send(Accountings&... accountings) {
        m_at += 4ms;
        ++m_sample;
        m_sample += next() % 50 == 0 ? next() % 20 : 0; // lost
        if (next() % 20'000 == 0) {
            m_sample = next(); // restarted
        }
        const bool isLate = next() % 40 == 0;
        const std::uint32_t sample = isLate ? m_sample - next() % 30 : m_sample;
        const auto parts = static_cast<std::uint8_t>(1 + sample % 3);
        for (std::uint8_t part = 0; part < parts; ++part) {
            if (next() % 60 == 0) {
                continue;
            }
            wire::Header header;
            header.sampleCounter = sample;
            header.datagramCounter = static_cast<std::uint8_t>(part | (part + 1 == parts ? 0x80 : 0));
            header.timeCode = static_cast<std::uint32_t>(m_at.time_since_epoch() / 1ms);
            const log::Packet packet{.number = m_number++, .stamp = m_at, .bytes = {}};
            (accountings.add(packet, header), ...);
        }
    }

private:
    std::uint32_t next() { return static_cast<std::uint32_t>(m_random()); }

    std::mt19937 m_random;
    log::Stamp m_at{100s};
    std::uint32_t m_sample = 1;
    std::uint64_t m_number = 0;
};

void expectSameCounts(const StreamAccounting& a, const StreamAccounting& b) {
    const StreamCounts one = a.counts();
    const StreamCounts other = b.counts();
    EXPECT_EQ(one.datagrams, other.datagrams);
    EXPECT_EQ(one.samples, other.samples);
    EXPECT_EQ(one.lost, other.lost);
    EXPECT_EQ(one.incomplete, other.incomplete);
    EXPECT_EQ(one.duplicates, other.duplicates);
    EXPECT_EQ(one.reordered, other.reordered);
    EXPECT_EQ(one.late, other.late);
    EXPECT_EQ(one.restarts, other.restarts);
    EXPECT_EQ(one.step, other.step);
    EXPECT_EQ(one.longestGapSamples, other.longestGapSamples);
    EXPECT_EQ(a.lossPattern().bursts, b.lossPattern().bursts);
    EXPECT_EQ(a.history().jitterMsAt(log::Stamp::max()), b.history().jitterMsAt(log::Stamp::max()));
}

constexpr AccountingDepth kShallow = AccountingDepth::of(4'096);

TEST(AccountingDepth, IsLessTheMoreStreamsThereAre) {
    EXPECT_EQ(AccountingDepth::of(0), AccountingDepth());
    EXPECT_EQ(AccountingDepth::of(512), AccountingDepth());
    EXPECT_EQ(AccountingDepth::of(513).samples, 2'048U);
    EXPECT_EQ(AccountingDepth::of(2'048).buckets, 512U);
    EXPECT_EQ(kShallow, (AccountingDepth{512, 256}));
    EXPECT_EQ(AccountingDepth::of(1'000'000), kShallow);
}

TEST(AccountingDepth, DoesNotChangeCounts) {
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        FaultyStream stream(seed);
        StreamAccounting full(2);
        StreamAccounting shallow(2);
        shallow.setDepth(kShallow);
        StreamAccounting changing(2);
        for (int i = 0; i < 30'000; ++i) {
            stream.send(full, shallow, changing);
            if (i % 3'001 == 0) {
                changing.setDepth(AccountingDepth::of(static_cast<std::size_t>(i % 5'000)));
            }
        }
        expectSameCounts(full, shallow);
        expectSameCounts(full, changing);
    }
}

TEST(AccountingDepth, BoundsTheMemoryOfAStream) {
    std::mt19937 random(3);
    for (const std::size_t streams : {512U, 1'024U, 2'048U, 4'096U}) {
        const AccountingDepth depth = AccountingDepth::of(streams);
        FaultyStream stream(7);
        StreamAccounting accounting(2);
        accounting.setDepth(depth);
        std::uint64_t number = 1'000'000;
        log::Stamp at{100s};
        std::uint32_t sample = 0;
        for (int i = 0; i < 60'000; ++i, at += 100ms) {
            wire::Header header;
            const bool isWild = random() % 100 == 0;
            header.sampleCounter = isWild ? static_cast<std::uint32_t>(random()) : ++sample;
            header.datagramCounter = static_cast<std::uint8_t>(1 + random() % 100);
            accounting.add({.number = ++number, .stamp = at, .bytes = {}}, header);
            sample = random() % 20'000 == 0 ? static_cast<std::uint32_t>(random()) : sample;
            ASSERT_LE(accounting.memoryBytes(), StreamAccounting::mostBytes(depth)) << streams;
        }
        EXPECT_GT(accounting.memoryBytes(), StreamAccounting::mostBytes(depth) / 2);
    }
}

TEST(AccountingDepth, GivesMemoryBackAndTakesItAgain) {
    FaultyStream stream(5);
    StreamAccounting accounting(2);
    const auto run = [&] {
        for (int i = 0; i < 60'000; ++i) {
            stream.send(accounting);
        }
    };
    run();
    const std::size_t full = accounting.memoryBytes();
    accounting.setDepth(kShallow);
    EXPECT_LE(accounting.memoryBytes(), StreamAccounting::mostBytes(kShallow));
    run();
    EXPECT_LE(accounting.memoryBytes(), StreamAccounting::mostBytes(kShallow));
    accounting.setDepth({});
    run();
    EXPECT_GT(accounting.memoryBytes(), full / 4);
    EXPECT_LE(accounting.memoryBytes(), StreamAccounting::mostBytes({}));
}

} // namespace
} // namespace posewire::model
