// SPDX-License-Identifier: MIT
#include "core/model/accounting/stream_accounting.h"

#include "tests/core/model/accounting/accounting_reference.h"
#include "tests/core/model/accounting/arrivals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <random>

namespace posewire::model {

void PrintTo(const StreamCounts& counts, std::ostream* stream) {
    *stream << "datagrams " << counts.datagrams << ", samples " << counts.samples << ", lost " << counts.lost
            << ", duplicates " << counts.duplicates << ", reordered " << counts.reordered << ", late "
            << counts.late << ", incomplete " << counts.incomplete << ", restarts " << counts.restarts
            << ", longest gap " << counts.longestGapSamples << ", step " << counts.step << ", first "
            << counts.firstSample << ", last " << counts.lastSample;
}

namespace {

using namespace std::chrono_literals;

/// A sender whose network does everything at once, as far as the seed says.
class FaultySender {
public:
    explicit FaultySender(std::uint32_t seed) : m_engine(seed) {
        m_drop = chance() < 0.7 ? chance() * 0.3 : 0;
        m_worsen = chance() < 0.4 ? 0.02 : 0;
        m_duplicate = chance() < 0.5 ? chance() * 0.1 : 0;
        m_reorder = chance() < 0.6 ? chance() * 0.15 : 0;
        constexpr log::Duration delays[] = {6ms, 30ms, 200ms, 700ms};
        m_delay = delays[pick(4)];
        m_split = chance() < 0.3;
    }

    void send() {
        m_sample = chance() < 0.2 ? UINT32_MAX - 200 : pick(100'000) + 10'000;
        begin({1 + (chance() < 0.3 ? pick(4) : 0), true});
        const std::uint32_t pieces = 1 + pick(3);
        for (std::uint32_t i = 0; i < pieces; ++i) {
            run(300 + pick(600));
            if (i + 1 < pieces) {
                change();
            }
        }
        std::stable_sort(arrivals.begin(), arrivals.end(),
                         [](const SentDatagram& a, const SentDatagram& b) { return a.stamp < b.stamp; });
    }

    std::vector<SentDatagram> arrivals;
    std::vector<SentRun> runs;

private:
    /// Below `end`.
    std::uint32_t pick(std::uint32_t end) { return static_cast<std::uint32_t>(m_engine() % end); }
    double chance() { return std::uniform_real_distribution<double>(0, 1)(m_engine); }

    void begin(SentRun run) { runs.push_back(run); }

    void change() {
        const double what = chance();
        if (what < 0.25 && m_sample - (m_delay <= 30ms ? 300 : 1'200) < UINT32_MAX / 2) {
            // Back, among known samples or below them.
            m_sample = m_sample < 100'000'000 ? pick(50) : m_sample - 150 - pick(500);
            begin({runs.back().step, true});
        } else if (what < 0.4) {
            m_sample += 20'000 + pick(1'000'000);
            begin({runs.back().step, true});
        } else if (what < 0.7) {
            std::uint32_t step = 1 + pick(4);
            step = step == runs.back().step ? step + 1 : step;
            m_sample += step - runs.back().step;
            begin({step, false});
        } else if (what < 0.85) {
            m_now += 900ms; // the sender pauses
        } else {
            m_sample += runs.back().step * (110 + pick(500)); // a long loss
        }
    }

    void run(std::uint32_t count) {
        for (std::uint32_t i = 0; i < count; ++i, m_sample += runs.back().step) {
            const bool isEdge = i < 2 || i + 2 >= count;
            m_isBad = m_isBad ? chance() > 0.2 : chance() < m_worsen;
            const std::uint8_t parts = m_split ? static_cast<std::uint8_t>(1 + pick(3)) : 1;
            for (std::uint8_t part = 0; part < parts; ++part) {
                const bool isDropped = chance() < m_drop || (m_isBad && chance() < 0.8);
                if (!isDropped || isEdge) {
                    arrive(part, part + 1 == parts, isEdge);
                }
            }
            m_now += 4'200us;
        }
    }

    void arrive(std::uint8_t part, bool isLast, bool isEdge) {
        SentDatagram datagram{m_now + part * 1us, m_sample, part, isLast, static_cast<int>(runs.size()) - 1};
        if (!isEdge && chance() < m_reorder) {
            datagram.stamp += 1ms + pick(1'000) * m_delay / 1'000;
        }
        arrivals.push_back(datagram);
        if (chance() < m_duplicate) {
            datagram.stamp += 1ns + pick(3) * 3ms;
            arrivals.push_back(datagram);
        }
    }

    std::mt19937 m_engine;
    double m_drop = 0;
    double m_worsen = 0; ///< Gilbert-Elliott
    double m_duplicate = 0;
    double m_reorder = 0;
    log::Duration m_delay{};
    bool m_split = false;
    bool m_isBad = false;
    log::Stamp m_now{1'700'000'000s};
    std::uint32_t m_sample = 0;
};

class RandomStreams : public testing::TestWithParam<std::uint32_t> {};

TEST_P(RandomStreams, AreCountedAsTheReferenceCountsThem) {
    constexpr std::uint32_t kSeeds = 200;
    for (std::uint32_t seed = GetParam() * kSeeds; seed < (GetParam() + 1) * kSeeds; ++seed) {
        FaultySender sender(seed);
        sender.send();
        StreamAccounting stream;
        std::size_t verdicts = 0;
        for (const SentDatagram& datagram : sender.arrivals) {
            wire::Header header;
            header.sampleCounter = datagram.sample;
            header.datagramCounter = static_cast<std::uint8_t>(datagram.index | (datagram.isLast ? 0x80 : 0));
            verdicts += addTo(stream, datagram.stamp, 760, header, header.sampleCounter).size();
        }
        StreamCounts expected = referenceCounts(sender.arrivals, sender.runs);
        StreamCounts counts = stream.counts();
        EXPECT_EQ(counts, expected) << "seed " << seed;
        if (!stream.isInDoubt()) {
            EXPECT_EQ(verdicts, sender.arrivals.size()) << "seed " << seed;
            const auto range = stream.countsBetween({}, log::Stamp::max());
            EXPECT_EQ(range.samples, counts.samples) << "seed " << seed;
            EXPECT_EQ(range.lost, counts.lost) << "seed " << seed;
            EXPECT_EQ(range.incomplete, counts.incomplete) << "seed " << seed;
            EXPECT_EQ(range.duplicates, counts.duplicates) << "seed " << seed;
            EXPECT_EQ(range.late, counts.late) << "seed " << seed;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomStreams, testing::Range(0U, 10U));

} // namespace
} // namespace posewire::model
