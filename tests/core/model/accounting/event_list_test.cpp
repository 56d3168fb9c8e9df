// SPDX-License-Identifier: MIT
#include "core/model/accounting/events.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace posewire::model {
namespace {

using namespace std::chrono_literals;

constexpr log::Stamp at(log::Duration time) {
    return log::Stamp(time);
}

Event eventAt(EventKind kind, log::Stamp stamp, std::uint32_t sender = 1) {
    Event event;
    event.kind = kind;
    event.sender = static_cast<log::SenderId>(sender);
    event.firstStamp = event.lastStamp = stamp;
    return event;
}

std::vector<std::uint64_t> numbersOf(const std::vector<const Event*>& events) {
    std::vector<std::uint64_t> numbers;
    for (const Event* event : events) {
        numbers.push_back(event->number);
    }
    return numbers;
}

TEST(EventList, PutsWhatHappensAgainIntoTheEpisodeThatLasts) {
    Events events;
    Event gap = eventAt(EventKind::Gap, at(1s));
    gap.samples = 3;
    gap.detail = "first";
    gap.lastPacket = 10;
    events.report(gap);
    gap = eventAt(EventKind::Gap, at(4s));
    gap.samples = 4;
    gap.detail = "second";
    gap.lastPacket = 90;
    events.report(gap);
    ASSERT_EQ(events.all().size(), 1U);
    const Event& all = events.all().front();
    EXPECT_EQ(all.firstStamp, at(1s));
    EXPECT_EQ(all.lastStamp, at(4s));
    EXPECT_EQ(all.lastPacket, 90U);
    EXPECT_EQ(all.count, 2U);
    EXPECT_EQ(all.samples, 7U);
    EXPECT_EQ(all.detail, "second") << "the evidence of the newest";
}

TEST(EventList, DoesNotLetAnEpisodeGoBackInTime) {
    Events events;
    Event event = eventAt(EventKind::LossLimit, at(5s));
    event.lastPacket = 50;
    event.value = 9;
    events.report(event);
    event.lastStamp = at(3s);
    event.lastPacket = 30;
    event.value = 2;
    events.report(event);
    EXPECT_EQ(events.all().front().lastStamp, at(5s));
    EXPECT_EQ(events.all().front().lastPacket, 50U);
    EXPECT_EQ(events.all().front().value, 9) << "the worst";
}

TEST(EventList, KeepsEpisodesApartThatDifferInAnythingThatTheyAreOf) {
    Events events;
    const Event base = eventAt(EventKind::Gap, at(1s));
    Event other = base;
    events.report(base);
    other.character = 1;
    events.report(other);
    other.type = 2;
    events.report(other);
    other.cause = LossCause::Network;
    events.report(other);
    other.cause = LossCause::Unknown;
    events.report(other);
    other.sender = static_cast<log::SenderId>(2);
    events.report(other);
    other.kind = EventKind::Burst;
    events.report(other);
    EXPECT_EQ(events.all().size(), 7U);
    EXPECT_EQ(numbersOf(events.current()), (std::vector<std::uint64_t>{0, 1, 2, 3, 4, 5, 6}));
}

TEST(EventList, KnowsWhatLastsOfOneSender) {
    Events events;
    Event event = eventAt(EventKind::SenderDown, at(1s));
    for (const std::uint32_t sender : {1U, 2U, 3U}) {
        event.sender = static_cast<log::SenderId>(sender);
        events.report(event);
    }
    event.sender = static_cast<log::SenderId>(2);
    event.kind = EventKind::Gap;
    event.character = 0;
    events.report(event);
    std::vector<std::uint64_t> numbers = numbersOf(events.currentOf(event.sender));
    EXPECT_THAT(numbers, testing::UnorderedElementsAre(1, 3));
    events.end(event, at(2s));
    EXPECT_EQ(numbersOf(events.currentOf(event.sender)), (std::vector<std::uint64_t>{1}));
    EXPECT_TRUE(events.currentOf(static_cast<log::SenderId>(4)).empty());
}

TEST(EventList, EndsWhatHasBeenQuietForFiveSeconds) {
    Events events;
    events.report(eventAt(EventKind::Gap, at(10s)));
    events.report(eventAt(EventKind::Stale, at(10s)));
    events.advance(at(15s - 1ns));
    EXPECT_EQ(events.current().size(), 2U);
    const std::uint64_t version = events.version();
    events.advance(at(15s));
    EXPECT_EQ(numbersOf(events.current()), (std::vector<std::uint64_t>{1}))
        << "a condition lasts until it is ended";
    EXPECT_GT(events.version(), version);
    events.advance(at(1'000s));
    EXPECT_EQ(events.current().size(), 1U);
    events.report(eventAt(EventKind::Gap, at(16s)));
    EXPECT_EQ(events.all().size(), 3U) << "an episode of its own";
}

TEST(EventList, EndsAConditionOnce) {
    Events events;
    const Event down = eventAt(EventKind::SenderDown, at(1s));
    events.report(down);
    events.end(down, at(9s));
    EXPECT_FALSE(events.isCurrent(down));
    EXPECT_FALSE(events.all().front().isCurrent);
    EXPECT_EQ(events.all().front().lastStamp, at(9s));
    const std::uint64_t version = events.version();
    events.end(down, at(20s));
    events.end(eventAt(EventKind::Stale, at(1s)), at(20s));
    EXPECT_EQ(events.all().front().lastStamp, at(9s));
    EXPECT_EQ(events.version(), version);
}

TEST(EventList, KnowsWhatLastedAtATimeOfThePast) {
    Events events;
    const Event down = eventAt(EventKind::SenderDown, at(10s));
    events.report(down);
    events.end(down, at(20s));
    events.report(eventAt(EventKind::Gap, at(30s)));
    events.report(eventAt(EventKind::AgeLimit, at(40s))); // lasts
    const auto countAt = [&events](log::Duration time) { return events.currentAt(at(time)).size(); };
    EXPECT_EQ(countAt(10s - 1ns), 0U);
    EXPECT_EQ(countAt(10s), 1U);
    EXPECT_EQ(countAt(20s - 1ns), 1U);
    EXPECT_EQ(countAt(20s), 0U);
    EXPECT_EQ(countAt(30s), 1U);
    EXPECT_EQ(countAt(35s - 1ns), 1U) << "what happened may happen again for 5 s";
    EXPECT_EQ(countAt(35s), 0U);
    EXPECT_EQ(countAt(40s), 1U);
    EXPECT_EQ(countAt(10'000s), 1U);
}

TEST(EventList, FindsByNumberWhatItStillHas) {
    Events events;
    EXPECT_EQ(events.find(0), nullptr);
    const Event lasting = eventAt(EventKind::SenderDown, at(1s), 0);
    events.report(lasting);
    for (std::uint32_t i = 1; i <= Events::kMost + 5; ++i) {
        const Event event = eventAt(EventKind::Gap, at(1s), i);
        events.report(event);
        events.end(event, at(2s));
    }
    ASSERT_NE(events.find(0), nullptr);
    EXPECT_EQ(events.find(0)->kind, EventKind::SenderDown);
    EXPECT_EQ(events.find(1), nullptr) << "the oldest that has ended was forgotten";
    EXPECT_EQ(events.find(6), nullptr);
    ASSERT_NE(events.find(7), nullptr);
    EXPECT_EQ(events.find(7)->number, 7U);
    EXPECT_EQ(events.find(Events::kMost + 6), nullptr);
}

TEST(EventKinds, AreEachNamedOnceAndHaveAText) {
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < kEventKinds; ++i) {
        const auto kind = static_cast<EventKind>(i);
        names.insert(nameOf(kind));
        Event event = eventAt(kind, at(1s));
        event.detail = "name: Ana → Berta";
        EXPECT_FALSE(event.text().empty()) << nameOf(kind);
        EXPECT_EQ(event.group() == EventGroup::Limit, kind >= EventKind::LossLimit) << nameOf(kind);
    }
    EXPECT_EQ(names.size(), kEventKinds);
}

TEST(EventTexts, CountOneAndMany) {
    Event event = eventAt(EventKind::Malformed, at(1s));
    EXPECT_EQ(event.text(), "1 datagram could not be decoded.");
    event.count = 2;
    EXPECT_EQ(event.text(), "2 datagrams could not be decoded.");
    event.kind = EventKind::Foreign;
    EXPECT_EQ(event.text(), "2 datagrams are not MXTP.");
    event.count = 1;
    EXPECT_EQ(event.text(), "1 datagram is not MXTP.");
    event.kind = EventKind::Dropped;
    event.samples = 1;
    EXPECT_EQ(event.text(), "This computer dropped 1 datagram.");
    event.samples = 40;
    EXPECT_EQ(event.text(), "This computer dropped 40 datagrams.");
}

TEST(EventTexts, SayWhatWasLostAndWhoseLossItWas) {
    Event event = eventAt(EventKind::Gap, at(1s));
    event.samples = 1;
    EXPECT_EQ(event.text(), "1 sample lost in 1 gap");
    event.samples = 12;
    event.count = 3;
    event.cause = LossCause::Network;
    EXPECT_EQ(event.text(), "12 samples lost in 3 gaps, cause: network.");
    event.cause = LossCause::ThisComputer;
    event.detail = "This computer dropped 2 datagrams.";
    EXPECT_EQ(event.text(),
              "12 samples lost in 3 gaps, cause: this computer. This computer dropped 2 datagrams.");
}

TEST(EventTexts, GiveLimitsTheirUnits) {
    const auto textOf = [](EventKind kind, double value, double limit) {
        Event event = eventAt(kind, at(1s));
        event.value = value;
        event.limit = limit;
        return event.text();
    };
    EXPECT_EQ(textOf(EventKind::LossLimit, 2.345, 1), "Loss 2.35 %, limit 1.00 %");
    EXPECT_EQ(textOf(EventKind::JitterLimit, 12.34, 10), "Jitter 12.3 ms, limit 10.0 ms");
    EXPECT_EQ(textOf(EventKind::GapLimit, 512.4, 250), "Gap 512 ms, limit 250 ms");
    EXPECT_EQ(textOf(EventKind::AgeLimit, 3.04, 1), "Age 3.0 s, limit 1.0 s");
    EXPECT_EQ(textOf(EventKind::RateLimit, 50, 20), "Rate off by 50.0 %, limit 20.0 %");
    EXPECT_EQ(textOf(EventKind::TimeCodeJump, -3'600'000, 0), "The time code jumped by -3600000 ms.");
}

} // namespace
} // namespace posewire::model
