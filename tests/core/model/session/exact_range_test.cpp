// SPDX-License-Identifier: MIT
#include "core/model/session/accounts.h"
#include "core/model/session/listed_incidents.h"
#include "tests/core/model/session/session_fixture.h"

#include <map>
#include <random>

namespace posewire::model {
namespace {

constexpr log::Duration kLength = 240s; // more than there are buckets of 0.1 s

/// A stream with every fault there is, in a file.
class ExactRange : public SessionTest {
protected:
    void SetUp() override {
        const double frame = 1e9 / 60;
        std::uint32_t held = 0; // sample, 0 for none
        for (std::uint32_t sample = 0; sample < 60 * kLength / 1s; ++sample) {
            const log::Stamp stamp = at(1000s + log::Duration(static_cast<std::int64_t>(frame * sample)));
            const auto fate = static_cast<std::uint32_t>(m_random() % 200);
            const bool isPause = sample % 4000 > 3900;
            if (fate < 6 || isPause) {
                continue;
            }
            if (fate == 6 && held == 0) {
                held = sample;
                continue;
            }
            sendSample(sample, stamp);
            if (held != 0) {
                sendSample(held, stamp + 1ms);
                held = 0;
            }
            if (fate == 7) {
                sendSample(sample, stamp + 2ms);
            }
            if (fate == 8) {
                sendBytes(wire::Bytes(m_newest).first(100), stamp + 3ms);
                m_stamps.push_back(stamp + 3ms);
            }
        }
        read(m_session);
    }

    void sendSample(std::uint32_t sample, log::Stamp stamp) {
        wire::Datagram datagram;
        datagram.body = swayingAt(0, sample);
        datagram.header.sampleCounter = sample;
        datagram.header.datagramCounter = 0x80;
        datagram.header.timeCode = sample * 50 / 3;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        m_newest = *wire::encode(datagram);
        sendBytes(m_newest, stamp);
        m_stamps.push_back(stamp);
    }

    static void read(Session& session) {
        while (session.followFile(at(2000s))) {
        }
        session.endFile();
    }

    TimeRange randomRange() {
        const auto one = [this] { return at(999s + log::Duration(m_random() % (kLength + 2s).count())); };
        const log::Stamp a = one();
        const log::Stamp b = one();
        return {std::min(a, b), std::max(a, b)};
    }

    void choose(const TimeRange& range) {
        m_session.setRange({.fixed = range});
        m_session.sharpenRange();
        m_session.sharpenRange();
    }

    const StreamAccounting& accounting(const Session& session) {
        return session.roster().streams().find({sender(), 0, 2})->accounting;
    }

    std::mt19937_64 m_random{7};
    std::vector<std::byte> m_newest;
    std::vector<log::Stamp> m_stamps; ///< of all packets
};

TEST_F(ExactRange, HoldsThePacketsThatAreInIt) {
    for (int round = 0; round < 100; ++round) {
        const TimeRange range = randomRange();
        choose(range);
        const auto in = std::ranges::count_if(
            m_stamps, [&range](log::Stamp stamp) { return stamp >= range.from && stamp < range.to; });
        const StreamAccounting& stream = accounting(m_session);
        ASSERT_EQ(stream.counts(range).datagrams + stream.malformed(range), in) << round;
        ASSERT_EQ(stream.malformed(range),
                  m_session.roster().senders().begin()->history.malformedBetween(range.from, range.to));
        ASSERT_EQ(stream.history().roundedUp(range.from), range.from);
    }
}

TEST_F(ExactRange, CountsAsASessionThatKnewTheRangeBeforehand) {
    for (int round = 0; round < 6; ++round) {
        const TimeRange range = randomRange();
        choose(range);
        Session knowing(m_log);
        knowing.setEdges(range);
        read(knowing);
        const StreamAccounting& ours = accounting(m_session);
        const StreamAccounting& theirs = accounting(knowing);
        ASSERT_EQ(ours.counts(range), theirs.counts(range)) << round;
        ASSERT_EQ(ours.interArrival(range).count, theirs.interArrival(range).count);
        ASSERT_NEAR(ours.interArrival(range).meanMs, theirs.interArrival(range).meanMs, 1e-6);
        ASSERT_NEAR(ours.interArrival(range).mostMs, theirs.interArrival(range).mostMs, 1e-3);
        ASSERT_NEAR(ours.clock(range).jitterMs, theirs.clock(range).jitterMs, 1e-3) << round;
        ASSERT_EQ(ours.lossPattern(range).meanBurstSamples, theirs.lossPattern(range).meanBurstSamples);
    }
}

TEST_F(ExactRange, IncidentsInItAddUpToItsCounts) {
    for (int round = 0; round < 50; ++round) {
        const TimeRange range = randomRange();
        choose(range);
        std::map<IncidentKind, std::uint64_t> times;
        std::uint64_t lost = 0;
        for (const ListedIncident& listed : listedIncidents(m_session, range.from, range.to)) {
            if (const auto its = withinRange(m_session, listed, range)) {
                times[its->incident.kind] += its->incident.count;
                lost += its->incident.samples;
            }
        }
        const StreamCounts counts = accounting(m_session).counts(range);
        ASSERT_EQ(lost, counts.lost) << round;
        ASSERT_EQ(times[IncidentKind::Duplicates], counts.duplicates);
        ASSERT_EQ(times[IncidentKind::Reordered], counts.reordered);
        ASSERT_EQ(times[IncidentKind::Malformed], accounting(m_session).malformed(range));
    }
}

TEST_F(ExactRange, LeavesAllThereIsAsItWas) {
    const StreamCounts before = accounting(m_session).countsBetween(log::Stamp::min(), log::Stamp::max());
    for (int round = 0; round < 10; ++round) {
        choose(randomRange());
    }
    EXPECT_EQ(accounting(m_session).countsBetween(log::Stamp::min(), log::Stamp::max()), before);
    EXPECT_EQ(accounting(m_session).counts().lost, before.lost);
}

} // namespace
} // namespace posewire::model
