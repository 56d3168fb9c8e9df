// SPDX-License-Identifier: MIT
#include "core/model/incidents/thresholds.h"

#include "tests/core/model/accounting/arrivals.h"
#include "tests/support/facts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <vector>

namespace posewire::model {
namespace {

using namespace std::chrono_literals;

constexpr log::Stamp after(log::Duration time) {
    return log::Stamp(time);
}

/// Streams of 100 samples a second that are held to their limits twice a second, as a session does.
class Limits : public testing::Test {
protected:
    void SetUp() override { addStream(2); }

    void addStream(std::uint8_t type) {
        m_streams.emplace_back(log::StreamKey{static_cast<log::SenderId>(1), 0, type});
    }
    void sendOne() {
        wire::Header header;
        header.sampleCounter = m_sample;
        header.timeCode = static_cast<std::uint32_t>(m_stamp.time_since_epoch() / 1ms);
        addTo(m_streams.front().accounting, m_stamp, 100, header);
    }
    void step(log::Duration apart = 10ms) {
        ++m_sample;
        m_stamp += apart;
        if (m_stamp >= m_nextCheck) {
            check();
            m_nextCheck = m_stamp + 500ms;
        }
    }
    void check() {
        for (Stream& stream : m_streams) {
            stream.isWatched = false;
            m_watch.wake(stream);
        }
        m_watch.check(m_stamp, m_events);
        m_watch.retire(static_cast<log::SenderId>(1)); // tests take streams away
        m_events.advance(m_stamp);
    }
    /// Sends for a while and loses `lost` of every 1,000 samples, evenly.
    void sendFor(log::Duration time, std::uint32_t lost = 0) {
        for (const log::Stamp end = m_stamp + time; m_stamp < end; step()) {
            if (m_sample * lost % 1'000 >= lost) {
                sendOne();
            }
        }
    }
    [[nodiscard]] std::vector<Incident> of(IncidentKind kind) const {
        std::vector<Incident> found;
        std::ranges::copy_if(m_events.all(), std::back_inserter(found),
                             [kind](const Incident& event) { return event.kind == kind; });
        return found;
    }
    [[nodiscard]] bool isAlert(IncidentKind kind) const {
        return std::ranges::any_of(m_events.current(), [kind](const Incident* e) { return e->kind == kind; });
    }
    void hold(Thresholds limits) { m_watch.set(limits); }

    std::deque<Stream> m_streams;
    ThresholdWatch m_watch;
    Incidents m_events;
    std::uint32_t m_sample = 1'000;
    log::Stamp m_stamp = after(100s);
    log::Stamp m_nextCheck{};
};

TEST_F(Limits, AreSilentForASteadyStream) {
    sendFor(60s);
    EXPECT_TRUE(m_events.all().empty());
}

TEST_F(Limits, OfLossAreOfWhatWasExpectedInTheWindow) {
    sendFor(30s, 5); // half of the limit of 1 %
    EXPECT_FALSE(isAlert(IncidentKind::LossLimit));
    sendFor(30s, 30);
    EXPECT_TRUE(isAlert(IncidentKind::LossLimit));
    ASSERT_EQ(of(IncidentKind::LossLimit).size(), 1U);
    EXPECT_NEAR(of(IncidentKind::LossLimit).back().value, 3, 0.5);
    EXPECT_EQ(of(IncidentKind::LossLimit).back().limit, 1);
    sendFor(10s);
    EXPECT_FALSE(isAlert(IncidentKind::LossLimit)) << "the window has passed it";
}

TEST_F(Limits, EndOnlyBelowTheirHysteresis) {
    Thresholds limits;
    limits.lossPercent = 10;
    limits.hysteresis = 0.5;
    limits.gapMs = limits.jitterMs = limits.ratePercent = 0;
    hold(limits);
    sendFor(20s, 200);
    EXPECT_TRUE(isAlert(IncidentKind::LossLimit));
    sendFor(20s, 70); // below the limit, above half of it
    EXPECT_TRUE(isAlert(IncidentKind::LossLimit));
    sendFor(20s, 200);
    EXPECT_EQ(of(IncidentKind::LossLimit).size(), 1U) << "a figure that hovers alerts once";
    sendFor(20s, 30);
    EXPECT_FALSE(isAlert(IncidentKind::LossLimit));
    sendFor(20s, 200);
    EXPECT_EQ(of(IncidentKind::LossLimit).size(), 2U);
    EXPECT_EQ(of(IncidentKind::LossLimit)[0].count, 1U);
}

TEST_F(Limits, OfZeroAreNone) {
    Thresholds limits;
    limits.lossPercent = limits.jitterMs = limits.gapMs = limits.ageS = limits.ratePercent = 0;
    hold(limits);
    sendFor(10s, 500);
    step(20s);
    sendFor(10s);
    check();
    EXPECT_TRUE(m_events.all().empty());
}

TEST_F(Limits, ThatAreSwitchedOffEndTheirAlerts) {
    sendFor(20s, 200);
    EXPECT_TRUE(isAlert(IncidentKind::LossLimit));
    Thresholds limits;
    limits.lossPercent = 0;
    hold(limits);
    sendFor(1s, 200);
    EXPECT_FALSE(isAlert(IncidentKind::LossLimit));
}

TEST_F(Limits, OfAGapAreOfTimeBetweenSamples) {
    for (const log::Duration apart : {250ms, 251ms}) {
        SetUp();
        m_streams.pop_front();
        m_events = Incidents();
        sendFor(10s);
        m_sample -= 1; // no sample is lost meanwhile
        step(apart - 10ms);
        sendFor(2s);
        EXPECT_EQ(isAlert(IncidentKind::GapLimit), apart > 250ms) << apart.count();
        EXPECT_FALSE(isAlert(IncidentKind::LossLimit));
        sendFor(6s);
        EXPECT_FALSE(isAlert(IncidentKind::GapLimit)) << "the window has passed it";
    }
}

TEST_F(Limits, OfAgeAreOfSilenceAndNeedNoSamples) {
    sendFor(10s);
    m_stamp = m_streams.front().accounting.lastStamp() + 1s;
    check();
    EXPECT_FALSE(isAlert(IncidentKind::AgeLimit));
    m_stamp += 1ms;
    check();
    EXPECT_TRUE(isAlert(IncidentKind::AgeLimit));
    m_stamp += 1h;
    check();
    ASSERT_EQ(of(IncidentKind::AgeLimit).size(), 1U);
    EXPECT_NEAR(of(IncidentKind::AgeLimit)[0].value, 3'601, 0.1);
    EXPECT_EQ(of(IncidentKind::AgeLimit)[0].severity(), IncidentSeverity::Error);
    m_nextCheck = {};
    sendFor(2s);
    EXPECT_FALSE(isAlert(IncidentKind::AgeLimit));
}

TEST_F(Limits, OfJitterAreOfRfc3550) {
    sendFor(10s);
    for (std::uint32_t i = 0; i < 300; ++i) { // every other sample is 30 ms under way
        wire::Header header;
        header.sampleCounter = m_sample;
        header.timeCode = static_cast<std::uint32_t>(m_stamp.time_since_epoch() / 1ms);
        addTo(m_streams.front().accounting, m_stamp + (i % 2 == 0 ? 0ms : 30ms), 100, header);
        step(40ms);
    }
    EXPECT_TRUE(isAlert(IncidentKind::JitterLimit));
    EXPECT_NEAR(of(IncidentKind::JitterLimit).front().value, 30, 3);
    sendFor(10s);
    EXPECT_FALSE(isAlert(IncidentKind::JitterLimit));
}

TEST_F(Limits, SayNothingOfACleanStreamHoweverLongItLasts) {
    sendFor(2h);
    EXPECT_TRUE(m_events.all().empty()) << m_events.all().front().fact();
    sendFor(10s, 50);
    EXPECT_TRUE(isAlert(IncidentKind::LossLimit)) << "and are as exact as before";
    EXPECT_NEAR(of(IncidentKind::LossLimit).front().value, 5, 0.5);
}

TEST_F(Limits, TellANewRateOfWhichNoSampleIsLost) {
    sendFor(30s);
    const log::Stamp from = m_stamp;
    for (const log::Stamp end = m_stamp + 30s; m_stamp < end; step(20ms)) {
        sendOne();
    }
    const auto steps = of(IncidentKind::Step);
    ASSERT_EQ(steps.size(), 1U);
    EXPECT_EQ(steps[0].detail.kind, words::Kind::RateChanged);
    EXPECT_NEAR(numberIn(steps[0].detail, "rate").value_or(0), 50, 0.5);
    EXPECT_NEAR(numberIn(steps[0].detail, "before").value_or(0), 100, 0.5);
    EXPECT_LE(steps[0].lastStamp - from, 2s) << "when it is told";
    EXPECT_LE(steps[0].firstStamp - from, 500ms);
    EXPECT_FALSE(isAlert(IncidentKind::RateLimit)) << "that is its rate now";
}

TEST_F(Limits, OfTheRateKnowWhatWasUsual) {
    sendFor(30s);
    for (const log::Stamp end = m_stamp + 6s; m_stamp < end; step(12ms)) { // 83 Hz: 17 % less
        sendOne();
    }
    EXPECT_FALSE(isAlert(IncidentKind::RateLimit));
    const auto unsteadily = [this](log::Duration time) { // never the same for long
        for (const log::Stamp end = m_stamp + time; m_stamp < end;
             step(m_stamp.time_since_epoch() % 1400ms < 700ms ? 14ms : 40ms)) {
            sendOne();
        }
    };
    unsteadily(6s);
    EXPECT_TRUE(isAlert(IncidentKind::RateLimit));
    EXPECT_TRUE(of(IncidentKind::Step).empty());
    unsteadily(400s);
    EXPECT_FALSE(isAlert(IncidentKind::RateLimit)) << "what lasts becomes usual";
}

TEST_F(Limits, OfTheRateTakeNoChanceForAChange) {
    for (const log::Duration interval : {700ms, 1'400ms, 1'700ms, 2'000ms}) {
        SCOPED_TRACE(interval / 1ms);
        for (int i = 0; i < 100; ++i) { // two checks a second, whatever the rate
            sendOne();
            for (const log::Stamp next = m_stamp + interval; m_stamp < next;) {
                m_stamp += 100ms;
                if (m_stamp >= m_nextCheck) {
                    check();
                    m_nextCheck = m_stamp + 500ms;
                }
            }
            ++m_sample;
        }
        EXPECT_TRUE(of(IncidentKind::RateLimit).empty());
        m_streams.clear();
        addStream(2);
        m_stamp += 60s;
    }
}

TEST_F(Limits, OfTheRateSayNothingBeforeAWholeWindow) {
    for (const log::Stamp end = m_stamp + 2s; m_stamp < end; step(2ms)) {
        sendOne();
    }
    sendFor(2s);
    EXPECT_FALSE(isAlert(IncidentKind::RateLimit));
}

TEST_F(Limits, HoldEveryStreamOnItsOwn) {
    addStream(21);
    for (std::uint32_t sample = 0; sample < 10; ++sample) {
        wire::Header header;
        header.sampleCounter = sample;
        addTo(m_streams.back().accounting, m_stamp + sample * 10ms, 100, header);
    }
    sendFor(5s); // of the first stream alone
    ASSERT_EQ(m_events.all().size(), 1U);
    EXPECT_EQ(m_events.all().front().kind, IncidentKind::AgeLimit);
    EXPECT_EQ(m_events.all().front().type(), 21);
    EXPECT_EQ(m_events.all().front().character()->character, 0);
}

TEST_F(Limits, LeaveTheUsualIntervalOfASlowStreamAlone) {
    for (int i = 0; i < 60; ++i) { // one a second, of which one is lost
        if (i != 30) {
            sendOne();
        }
        step(500ms);
        step(500ms);
    }
    EXPECT_TRUE(of(IncidentKind::GapLimit).empty());
    EXPECT_TRUE(of(IncidentKind::AgeLimit).empty());
    for (int i = 0; i < 8; ++i) {
        step(500ms);
    }
    EXPECT_TRUE(isAlert(IncidentKind::AgeLimit)) << "four intervals are one too many";
    EXPECT_NEAR(of(IncidentKind::AgeLimit)[0].limit, 3, 0.2);
}

TEST_F(Limits, SayNothingWhereAnIncidentSaysWhy) {
    sendFor(10s);
    m_streams.front().excusedUntil = m_stamp + 30s;
    Occurrence loss = Occurrence::at(IncidentKind::Loss, static_cast<log::SenderId>(1), m_stamp);
    loss.character = 0;
    loss.type = 2;
    loss.samples = 60;
    m_events.report(loss);
    sendFor(2s, 50);
    EXPECT_FALSE(isAlert(IncidentKind::LossLimit));
    ASSERT_TRUE(isAlert(IncidentKind::Loss));
    EXPECT_GT(of(IncidentKind::Loss)[0].value, 1) << "the loss is that much above the limit";
    EXPECT_EQ(of(IncidentKind::Loss)[0].severity(), IncidentSeverity::Error);
}

TEST_F(Limits, LeaveMessagesThatAreRepeatedAlone) {
    // Types 10 to 13 are outside sample accounting: they have no age, no rate and no loss.
    m_streams.clear();
    addStream(12);
    addStream(13);
    for (Stream& stream : m_streams) {
        wire::Header header;
        header.datagramCounter = 0; // the first part of more that never come
        addTo(stream.accounting, m_stamp, 100, header);
    }
    for (int i = 0; i < 100; ++i) {
        m_stamp += 500ms;
        check();
    }
    EXPECT_TRUE(m_events.all().empty());
}

} // namespace
} // namespace posewire::model
