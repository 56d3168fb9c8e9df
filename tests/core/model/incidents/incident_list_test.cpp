// SPDX-License-Identifier: MIT
#include "core/model/incidents/incidents.h"

#include "tests/support/facts.h"

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

Occurrence occurrenceAt(IncidentKind kind, log::Stamp stamp, std::uint32_t sender = 1) {
    return Occurrence::at(kind, static_cast<log::SenderId>(sender), stamp);
}

Incident incidentOf(IncidentKind kind) {
    Incident incident;
    incident.kind = kind;
    incident.count = 1;
    return incident;
}

constexpr auto kOne = static_cast<log::SenderId>(1);
constexpr CharacterKey kFirst{kOne, 0};
constexpr CharacterKey kSecond{kOne, 1};
constexpr CharacterKey kThird{kOne, 2};
constexpr CharacterKey kFourth{kOne, 3};

std::uint64_t samplesOf(const Incident& incident, log::SenderId sender) {
    std::uint64_t sum = 0;
    incident.forEachShare(
        [&](log::SenderId one, std::uint64_t samples) { sum += one == sender ? samples : 0; });
    return sum;
}

std::vector<std::uint64_t> numbersOf(const std::vector<const Incident*>& events) {
    std::vector<std::uint64_t> numbers;
    for (const Incident* event : events) {
        numbers.push_back(event->number);
    }
    return numbers;
}

TEST(IncidentList, PutsWhatHappensAgainIntoTheEpisodeThatLasts) {
    Incidents incidents;
    Occurrence gap = occurrenceAt(IncidentKind::Loss, at(1s));
    gap.samples = 3;
    gap.detail = {words::Kind::AsStreamBegan};
    gap.toPacket = 10;
    incidents.report(gap);
    gap = occurrenceAt(IncidentKind::Loss, at(4s));
    gap.samples = 4;
    gap.detail = {words::Kind::PartOfMessage};
    gap.toPacket = 90;
    incidents.report(gap);
    ASSERT_EQ(incidents.all().size(), 1U);
    const Incident& all = incidents.all().front();
    EXPECT_EQ(all.firstStamp, at(1s));
    EXPECT_EQ(all.lastStamp, at(4s));
    EXPECT_EQ(all.lastPacket, 90U);
    EXPECT_EQ(all.count, 2U);
    EXPECT_EQ(all.samples, 7U);
    EXPECT_EQ(all.detail.kind, words::Kind::PartOfMessage) << "the evidence of the newest";
}

TEST(IncidentList, DoesNotLetAnIncidentGoBackInTime) {
    Incidents incidents;
    Occurrence one = occurrenceAt(IncidentKind::LossLimit, at(5s));
    one.toPacket = 50;
    one.value = 9;
    incidents.report(one);
    one.to = at(3s);
    one.toPacket = 30;
    one.value = 2;
    incidents.report(one);
    EXPECT_EQ(incidents.all().front().lastStamp, at(5s));
    EXPECT_EQ(incidents.all().front().lastPacket, 50U);
    EXPECT_EQ(incidents.all().front().value, 9) << "the worst";
}

TEST(IncidentList, PutsAllStreamsOfASenderIntoOneAndOtherSendersAndCausesApart) {
    Incidents incidents;
    Occurrence one = occurrenceAt(IncidentKind::Loss, at(1s));
    one.samples = 2;
    one.cause = LossCause::Network;
    for (std::uint8_t character = 0; character < 4; ++character) {
        for (std::uint8_t type = 20; type < 26; ++type) {
            one.character = character;
            one.type = type;
            incidents.report(one);
        }
    }
    ASSERT_EQ(incidents.all().size(), 1U);
    EXPECT_EQ(incidents.all().front().samples, 48U);
    EXPECT_EQ(incidents.all().front().parts.size(), 24U);
    EXPECT_EQ(incidents.all().front().characters(), (std::vector{kFirst, kSecond, kThird, kFourth}));
    EXPECT_EQ(incidents.all().front().types(), (std::vector<std::uint8_t>{20, 21, 22, 23, 24, 25}));
    EXPECT_EQ(incidents.all().front().character(), std::nullopt);
    one.cause = LossCause::Sender;
    incidents.report(one);
    one.sender = static_cast<log::SenderId>(2);
    incidents.report(one);
    EXPECT_EQ(numbersOf(incidents.current()), (std::vector<std::uint64_t>{1, 2, 3}));
    EXPECT_EQ(incidents.all().back().character(), (CharacterKey{one.sender, 3}));
}

TEST(IncidentList, TakesBackWhatCameAfterAllAndForgetsWhatComesToNothing) {
    Incidents incidents;
    Occurrence one = occurrenceAt(IncidentKind::Loss, at(1s));
    one.character = 0;
    one.type = 2;
    one.samples = 5;
    const std::uint64_t number = incidents.report(one);
    one.type = 21;
    incidents.report(one);
    const Incident::Part first{one.sender, 0, 2};
    const Incident::Part second{one.sender, 0, 21};
    incidents.takeBack(number, first, 2, 0);
    EXPECT_EQ(incidents.find(number)->samples, 8U);
    EXPECT_EQ(incidents.find(number)->count, 2U);
    incidents.takeBack(number, first, 3, 1);
    EXPECT_EQ(incidents.find(number)->types(), (std::vector<std::uint8_t>{21}));
    EXPECT_EQ(incidents.find(number)->count, 1U);
    incidents.end(number, at(9s));
    incidents.takeBack(number, second, 5, 1);
    EXPECT_EQ(incidents.find(number), nullptr) << "it is gone, not over";
    EXPECT_TRUE(incidents.current().empty());
}

TEST(IncidentList, KeepsTheNumberOfWhatIsNotSettledYet) {
    Incidents incidents;
    const auto sender = static_cast<log::SenderId>(1);
    const std::uint64_t reserved = incidents.reserve(sender);
    EXPECT_EQ(incidents.reserve(sender), reserved);
    const std::uint64_t other = incidents.report(occurrenceAt(IncidentKind::Restart, at(1s)));
    EXPECT_NE(other, reserved);
    EXPECT_EQ(incidents.report(occurrenceAt(IncidentKind::Loss, at(1s))), reserved);
    EXPECT_EQ(incidents.all().front().number, reserved) << "in the order of numbers";
    EXPECT_NE(incidents.reserve(sender), reserved);
}

TEST(IncidentList, EndsWithItsLastPart) {
    Incidents incidents;
    Occurrence one = occurrenceAt(IncidentKind::Outage, at(1s));
    one.character = 0;
    const std::uint64_t number = incidents.report(one);
    one.character = 1;
    incidents.report(one);
    incidents.endPart(number, kFirst, {}, at(3s));
    EXPECT_TRUE(incidents.find(number)->isCurrent);
    EXPECT_FALSE(incidents.find(number)->concerns(kFirst));
    EXPECT_TRUE(incidents.find(number)->concerns(kSecond));
    incidents.endPart(number, kSecond, {}, at(4s));
    EXPECT_FALSE(incidents.find(number)->isCurrent);
    EXPECT_EQ(incidents.find(number)->lastStamp, at(4s));
    EXPECT_TRUE(incidents.find(number)->concerns(kFirst)) << "it did";
}

TEST(IncidentList, JoinsTheOutagesOfHostsThatWereSilentTogether) {
    Incidents incidents;
    std::vector<std::uint64_t> numbers;
    for (std::uint32_t sender = 1; sender <= 3; ++sender) {
        Occurrence one = occurrenceAt(IncidentKind::Outage, at(sender == 3 ? 60s : 1s));
        one.sender = static_cast<log::SenderId>(sender);
        one.character = 0;
        one.to = one.from + 1s;
        one.samples = 40;
        one.detail = {words::Kind::HostsSilent};
        one.isOver = true;
        numbers.push_back(incidents.report(one));
        incidents.end(numbers.back(), one.to);
        EXPECT_EQ(incidents.joinOutages(numbers.back()), sender == 3 ? numbers[2] : numbers[0]);
    }
    ASSERT_EQ(incidents.all().size(), 2U) << "the third was another time";
    const Incident& both = incidents.all().front();
    EXPECT_EQ(both.samples, 80U);
    EXPECT_EQ(both.characters().size(), 2U);
    EXPECT_EQ(samplesOf(both, static_cast<log::SenderId>(2)), 40U);
    EXPECT_EQ(incidents.find(numbers[1]), &both) << "by either number";
    Incident::Part part;
    part.sender = static_cast<log::SenderId>(2);
    part.character = 0;
    incidents.takeBack(numbers[1], part, 40, 1);
    EXPECT_EQ(samplesOf(both, static_cast<log::SenderId>(2)), 0U);
    EXPECT_EQ(both.samples, 40U);
}

TEST(IncidentList, IsFoundByItsCauseOnceThatIsKnown) {
    Incidents incidents;
    Occurrence one = occurrenceAt(IncidentKind::Outage, at(1s));
    const std::uint64_t number = incidents.report(one);
    incidents.setCause(number, LossCause::Sender);
    EXPECT_EQ(incidents.currentLike(one), nullptr);
    one.cause = LossCause::Sender;
    ASSERT_NE(incidents.currentLike(one), nullptr);
    EXPECT_EQ(incidents.currentLike(one)->number, number);
}

TEST(IncidentList, KnowsWhatLastsOfOneSender) {
    Incidents incidents;
    for (const std::uint32_t sender : {1U, 2U, 3U}) {
        incidents.report(occurrenceAt(IncidentKind::Outage, at(1s), sender));
    }
    const Occurrence loss = occurrenceAt(IncidentKind::Loss, at(1s), 2);
    const std::uint64_t number = incidents.report(loss);
    EXPECT_THAT(numbersOf(incidents.currentOf(loss.sender)), testing::UnorderedElementsAre(2, 4));
    incidents.end(number, at(2s));
    EXPECT_EQ(numbersOf(incidents.currentOf(loss.sender)), (std::vector<std::uint64_t>{2}));
    EXPECT_TRUE(incidents.currentOf(static_cast<log::SenderId>(4)).empty());
}

TEST(IncidentList, EndsWhatHasBeenQuietForFiveSeconds) {
    Incidents incidents;
    incidents.report(occurrenceAt(IncidentKind::Loss, at(10s)));
    incidents.report(occurrenceAt(IncidentKind::Outage, at(10s)));
    incidents.advance(at(15s - 1ns));
    EXPECT_EQ(incidents.current().size(), 2U);
    const std::uint64_t version = incidents.version();
    incidents.advance(at(15s));
    EXPECT_EQ(numbersOf(incidents.current()), (std::vector<std::uint64_t>{2}))
        << "a condition lasts until it is ended";
    EXPECT_GT(incidents.version(), version);
    incidents.advance(at(1'000s));
    EXPECT_EQ(incidents.current().size(), 1U);
    incidents.report(occurrenceAt(IncidentKind::Loss, at(16s)));
    EXPECT_EQ(incidents.all().size(), 3U) << "an episode of its own";
}

TEST(IncidentList, EndsAConditionOnce) {
    Incidents incidents;
    const Occurrence down = occurrenceAt(IncidentKind::Outage, at(1s));
    const std::uint64_t number = incidents.report(down);
    incidents.end(number, at(9s));
    EXPECT_EQ(incidents.currentLike(down), nullptr);
    EXPECT_FALSE(incidents.all().front().isCurrent);
    EXPECT_EQ(incidents.all().front().lastStamp, at(9s));
    const std::uint64_t version = incidents.version();
    incidents.end(number, at(20s));
    incidents.end(number + 1, at(20s));
    EXPECT_EQ(incidents.all().front().lastStamp, at(9s));
    EXPECT_EQ(incidents.version(), version);
}

TEST(IncidentList, AFigureThatHoversAboutItsLimitIsOne) {
    Incidents incidents;
    for (const log::Duration time : {1s, 5s, 9s}) {
        const std::uint64_t number = incidents.report(occurrenceAt(IncidentKind::JitterLimit, at(time)));
        EXPECT_EQ(number, 1U);
        EXPECT_EQ(numbersOf(incidents.current()), (std::vector<std::uint64_t>{1}));
        incidents.end(number, at(time + 1s));
        EXPECT_TRUE(incidents.current().empty());
    }
    EXPECT_EQ(incidents.all().front().count, 3U);
    EXPECT_EQ(incidents.report(occurrenceAt(IncidentKind::JitterLimit, at(15s))), 2U) << "long after";
    incidents.end(2, at(16s));
    EXPECT_EQ(incidents.report(occurrenceAt(IncidentKind::GapLimit, at(17s))), 3U) << "another limit";
}

TEST(IncidentList, KnowsWhatLastedAtATimeOfThePast) {
    Incidents incidents;
    incidents.end(incidents.report(occurrenceAt(IncidentKind::Outage, at(10s))), at(20s));
    incidents.report(occurrenceAt(IncidentKind::Loss, at(30s)));
    incidents.report(occurrenceAt(IncidentKind::AgeLimit, at(40s))); // lasts
    const auto countAt = [&incidents](log::Duration time) { return incidents.currentAt(at(time)).size(); };
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

TEST(IncidentList, FindsByNumberWhatItStillHas) {
    Incidents incidents;
    EXPECT_EQ(incidents.find(1), nullptr);
    const std::uint64_t lasting = incidents.report(occurrenceAt(IncidentKind::Outage, at(1s), 0));
    std::uint64_t last = 0;
    for (std::uint32_t i = 1; i <= Incidents::kMost + 5; ++i) {
        last = incidents.report(occurrenceAt(IncidentKind::Loss, at(1s), i));
        incidents.end(last, at(2s));
    }
    ASSERT_NE(incidents.find(lasting), nullptr);
    EXPECT_EQ(incidents.find(lasting)->kind, IncidentKind::Outage);
    EXPECT_EQ(incidents.find(lasting + 1), nullptr) << "the oldest that has ended was forgotten";
    EXPECT_EQ(incidents.find(lasting + 6), nullptr);
    ASSERT_NE(incidents.find(lasting + 7), nullptr);
    EXPECT_EQ(incidents.find(lasting + 7)->number, lasting + 7);
    EXPECT_EQ(incidents.find(last + 1), nullptr);
}

TEST(IncidentList, JoinsTheOldestThatAreAlikeWhenThereAreTooMany) {
    Incidents incidents;
    constexpr std::uint32_t kBeyond = 2'000;
    for (std::uint32_t i = 1; i <= Incidents::kMost + kBeyond; ++i) {
        Occurrence loss = occurrenceAt(IncidentKind::Loss, at(i * 6s));
        loss.samples = 1;
        incidents.end(incidents.report(loss), at(i * 6s));
    }
    EXPECT_EQ(incidents.all().size(), Incidents::kMost);
    const Incident& oldest = incidents.all().front();
    EXPECT_EQ(oldest.samples, kBeyond + 1);
    EXPECT_EQ(oldest.count, kBeyond + 1);
    EXPECT_EQ(oldest.firstStamp, at(6s));
    EXPECT_EQ(oldest.lastStamp, at((kBeyond + 1) * 6s));
    EXPECT_EQ(oldest.parts.size(), 1U);
    EXPECT_EQ(oldest.parts.front().samples, kBeyond + 1);
}

TEST(IncidentList, IsBoundedAlsoInItsParts) {
    Incidents incidents;
    for (std::uint32_t i = 0; i < 300; ++i) {
        Occurrence one = occurrenceAt(IncidentKind::Loss, at(1s), i);
        one.samples = 1;
        for (int part = 0; part < 1'000; ++part) {
            one.character = static_cast<std::uint8_t>(part % 250);
            one.type = static_cast<std::uint8_t>(part / 250);
            incidents.report(one);
        }
        incidents.end(incidents.all().back().number, at(2s));
    }
    EXPECT_LE(incidents.all().size(), Incidents::kMostParts / 1'000 + 1);
    EXPECT_GE(incidents.all().size(), Incidents::kMostParts / 1'000 - 1);
}

TEST(IncidentKinds, AreEachNamedOnceAndHaveAText) {
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < kIncidentKinds; ++i) {
        const auto kind = static_cast<IncidentKind>(i);
        names.insert(nameOf(kind));
        Incident event = incidentOf(kind);
        event.detail = {words::Kind::MetadataChanged, {{"changes", std::string("name: Ana → Berta")}}};
        EXPECT_FALSE(say(event.fact(), words::Form::Sentence).empty()) << nameOf(kind);
        EXPECT_EQ(event.group() == IncidentGroup::Limit, kind >= IncidentKind::LossLimit) << nameOf(kind);
    }
    EXPECT_EQ(names.size(), kIncidentKinds);
}

TEST(IncidentFacts, CountWhatHappened) {
    Incident event = incidentOf(IncidentKind::Malformed);
    event.count = 2;
    EXPECT_EQ(event.fact().kind, words::Kind::Malformed);
    EXPECT_EQ(partOf(event.fact(), "count"), words::counted(words::Kind::Datagrams, 2));
    event.kind = IncidentKind::Foreign;
    EXPECT_EQ(event.fact().kind, words::Kind::NotMxtp);
    event.kind = IncidentKind::Local;
    event.value = 40;
    EXPECT_EQ(event.fact().kind, words::Kind::LostHere);
    EXPECT_EQ(partOf(event.fact(), "dropped"), words::counted(words::Kind::Datagrams, 40));
    EXPECT_TRUE(partOf(event.fact(), "missing").isNothing());
    event.samples = 3;
    EXPECT_EQ(partOf(partOf(event.fact(), "missing"), "n"), words::counted(words::Kind::Samples, 3));
}

TEST(IncidentFacts, TellWhatWasLostAndWhoseLossItWas) {
    Incident event = incidentOf(IncidentKind::Loss);
    event.samples = 12;
    event.count = 3;
    EXPECT_TRUE(partOf(event.fact(), "cause").isNothing());
    event.cause = LossCause::ThisComputer;
    event.detail = {words::Kind::NotListening};
    EXPECT_EQ(toldIn(event.fact()).amount, 12);
    EXPECT_EQ(toldIn(event.fact()).cause, words::Kind::CauseThisComputer);
    EXPECT_EQ(partOf(event.fact(), "gaps"), words::counted(words::Kind::Gaps, 3));
    EXPECT_EQ(partOf(event.fact(), "evidence"), event.detail);
}

TEST(IncidentFacts, GiveLimitsTheirDecimals) {
    const auto textOf = [](IncidentKind kind, double value, double limit) {
        Incident event = incidentOf(kind);
        event.value = value;
        event.limit = limit;
        return say(event.fact(), words::Form::Sentence);
    };
    EXPECT_EQ(textOf(IncidentKind::LossLimit, 2.345, 1), "Loss 2.35 %, limit 1 %.");
    EXPECT_EQ(textOf(IncidentKind::JitterLimit, 12.34, 10), "Jitter 12.3 ms, limit 10 ms.");
    EXPECT_EQ(textOf(IncidentKind::GapLimit, 512.4, 250), "Gap 512 ms, limit 250 ms.");
    EXPECT_EQ(textOf(IncidentKind::AgeLimit, 3.04, 1.5), "Age 3.0 s, limit 1.5 s.");
    EXPECT_EQ(textOf(IncidentKind::RateLimit, 50, 20), "Rate off by 50.0 %, limit 20 %.");
}

} // namespace
} // namespace posewire::model
