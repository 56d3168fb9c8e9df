// SPDX-License-Identifier: MIT
#include "core/model/session/verdict.h"
#include "core/words/say.h"
#include "tests/core/model/session/session_fixture.h"

#include "core/model/incidents/incident_follower.h"
#include "core/model/session/roster.h"
#include "core/wire/types.h"

#include <algorithm>
#include <iterator>

namespace posewire::model {
namespace {

/// Somebody sets the clock of the receiving computer while a character is sent at 250 Hz.
class ClockSetTest : public SessionTest {
protected:
    static constexpr log::Duration kPeriod = 4ms;
    static constexpr log::Duration kBegin = 1'700'000'000s;

    void sendUntil(std::uint32_t end) {
        for (; m_sample < end; ++m_sample) {
            send(swayingAt(0, m_sample), m_sample, at(kBegin + m_sample * kPeriod));
        }
        follow();
    }
    void set(log::Duration change) {
        m_setBy += change;
        m_log.timeline().add({at(kBegin + m_sample * kPeriod - 1ms), m_setBy, change});
    }
    [[nodiscard]] std::vector<Incident> sets() const {
        std::vector<Incident> found;
        std::ranges::copy_if(m_session.verdicts().incidents().all(), std::back_inserter(found),
                             [](const Incident& event) { return event.kind == IncidentKind::ClockSet; });
        return found;
    }

    std::uint32_t m_sample = 0;
    log::Duration m_setBy{};
};

TEST_F(ClockSetTest, IsAnEventOfThisComputerInItsPlace) {
    sendUntil(100);
    set(-1h);
    sendUntil(200);
    set(2500ms);
    sendUntil(300);
    ASSERT_EQ(sets().size(), 2U);
    EXPECT_EQ(sets()[0].sender, log::kNoSender);
    EXPECT_EQ(sets()[0].firstPacket, 100U);
    EXPECT_EQ(sets()[0].value, -3600.0);
    EXPECT_FALSE(sets()[0].isCurrent);
    EXPECT_EQ(words::say(sets()[0].fact(), words::Form::Sentence),
              "The receiving computer's clock was set back by 3600.000 s.");
    EXPECT_EQ(sets()[1].firstPacket, 200U);
    EXPECT_EQ(words::say(sets()[1].fact(), words::Form::Sentence),
              "The receiving computer's clock was set forward by 2.500 s.");
}

TEST_F(ClockSetTest, IsNobodysLossRestartOrJitter) {
    sendUntil(500);
    set(-1h);
    sendUntil(1000);
    set(10h);
    sendUntil(1500);
    for (const Incident& event : m_session.verdicts().incidents().all()) {
        EXPECT_TRUE(event.kind == IncidentKind::ClockSet || event.kind == IncidentKind::SourceUp)
            << event.fact();
    }
    const Stream* stream = m_session.roster().find(log::StreamKey{sender(), 0, 2});
    ASSERT_NE(stream, nullptr);
    const StreamCounts counts = stream->accounting.counts();
    EXPECT_EQ(counts.lost, 0U);
    EXPECT_EQ(counts.restarts, 0U);
    EXPECT_EQ(counts.samples, 1500U);
    EXPECT_EQ(m_session.verdicts().of(key()).state, TakeVerdict::State::Good);
}

TEST_F(ClockSetTest, ShowsInTimesOfDayOnly) {
    sendUntil(100);
    set(-1h);
    sendUntil(101);
    const auto before = m_session.packet(99)->stamp;
    const auto after = m_session.packet(100)->stamp;
    EXPECT_EQ(after - before, kPeriod);
    EXPECT_EQ(m_session.wallOf(after) - m_session.wallOf(before), kPeriod - 1h);
}

TEST_F(ClockSetTest, IsToldAlsoWhereNothingComesAnyMore) {
    sendUntil(100);
    set(-1h);
    m_now += 1ms;
    follow();
    EXPECT_TRUE(sets().empty()) << "a packet may still show where it was";
    m_now += 2s;
    follow();
    EXPECT_EQ(sets().size(), 1U);
}

} // namespace
} // namespace posewire::model
