// SPDX-License-Identifier: MIT
#include "core/model/session/content.h"

#include "core/model/body/character_pose.h"
#include "core/model/body/null_pose.h"
#include "core/model/body/null_pose_findings.h"
#include "core/model/incidents/incident_follower.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <optional>
#include <set>
#include <utility>
#include <variant>
#include <vector>

namespace posewire::model {
namespace {

/// The usual time between two looks for contradictions.
constexpr log::Duration kContradictions = std::chrono::milliseconds(500);

/// The changes that a packet made, tag by tag; empty if it brought nothing new.
std::vector<words::Fact> changesBy(const Metadata& metadata, std::uint64_t packet) {
    std::vector<words::Fact> changes;
    for (const MetadataTag& tag : metadata.tags()) {
        if (tag.values.size() > 1 && tag.values.back().packet == packet) {
            changes.push_back({words::Kind::TagChanged,
                               {{"name", tag.name.shown()},
                                {"from", tag.values[tag.values.size() - 2].text.shown()},
                                {"to", tag.values.back().text.shown()}}});
        }
    }
    return changes;
}

/// Nothing if the null pose has no error.
words::Fact contradictionOf(const NullPoseRecord& record) {
    auto error = gravestError(record);
    return error ? words::Fact{words::Kind::Contradiction, {{"what", *std::move(error)}}} : words::Fact();
}

/// How far the clock of a sender is ahead of this computer's, in ms, if it sends the time of day: type 25 or
/// time codes that are near it. A playback has those of its recording, or counts from 0. With the packet that
/// says so.
std::optional<std::pair<std::int32_t, std::uint64_t>> clockAhead(const Sender& sender) {
    constexpr std::int32_t kDay = 86'400'000;
    constexpr std::int32_t kNear = 300'000;
    std::optional<std::pair<std::int32_t, std::uint64_t>> found;
    for (const Character* character : sender.characters) {
        for (const Stream* stream : character->streams) {
            const Message& newest = stream->newest;
            const auto* timeCode = std::get_if<wire::TimeCode>(&newest.datagram.body);
            const std::int64_t sent =
                timeCode != nullptr ? timeCode->milliseconds() : newest.datagram.header.timeCode;
            const auto here = log::millisecondsOf(newest.stamp.time_since_epoch());
            const auto ahead = static_cast<std::int32_t>(
                std::remainder(static_cast<double>(sent) - std::fmod(here, kDay), kDay));
            if (std::abs(ahead) < kNear && (timeCode != nullptr || sent > kNear)) {
                found = {ahead, newest.packet};
            }
            if (found && timeCode != nullptr) {
                return found;
            }
        }
    }
    return found;
}

/// Types that would be datagrams larger than an Ethernet frame, of as many segments, and that have not come.
std::vector<std::uint8_t> missingLargeTypes(const Sender& sender) {
    constexpr std::size_t kFrame = 1472;
    std::size_t segments = 0;
    std::set<std::uint8_t> come;
    for (const Character* character : sender.characters) {
        for (const Stream* stream : character->streams) {
            segments = std::max<std::size_t>(segments, stream->newest.datagram.header.countedSegments());
            come.insert(stream->key.type);
        }
    }
    std::vector<std::uint8_t> missing;
    for (const wire::TypeInfo& info : wire::typeTable()) {
        constexpr std::uint8_t kUnity = 5; // the body alone
        const std::size_t size = wire::kHeaderSize + segments * info.fields().back().size;
        if (wire::countsSegments(info.type) && info.type != kUnity && size > kFrame) {
            missing.push_back(info.type);
        }
    }
    const bool isAny = std::ranges::any_of(missing, [&](std::uint8_t type) { return come.contains(type); });
    return isAny ? std::vector<std::uint8_t>() : missing; // else large ones do get here
}

} // namespace

void Content::take(const Observed& seen) {
    if (const auto* message = std::get_if<wire::MetaData>(&seen.datagram->body)) {
        takeMetadata(*message, seen);
    } else if (const auto* part = std::get_if<wire::NullPose>(&seen.datagram->body)) {
        takeNullPose(*part, seen);
    } else if (seen.header->datagramIndex() == 0) {
        if (const auto* timeCode = std::get_if<wire::TimeCode>(&seen.datagram->body)) {
            seen.character->content.takeTimeCode(
                {seen.character->key, seen.packet, *seen.datagram, *seen.stream}, *timeCode, m_incidents);
        }
        if (hasPoses(seen.header->type()) && seen.character->isConfirmed) {
            Character& character = *seen.character;
            const NullPose* nullPose =
                character.isNullPoseUsable ? character.nullPoses->at(seen.packet.number) : nullptr;
            character.content.take({character.key, seen.packet, *seen.datagram, *seen.stream,
                                    seen.sender->positionUnit(seen.header->type()), seen.sender->up()},
                                   nullPose, m_incidents);
        }
        if (hasPoses(seen.header->type())) {
            seen.character->bends.add(*seen.datagram);
        }
        if (BodyMeasure& body = seen.character->measuredBody;
            !body.isSettled() && hasPoses(seen.header->type()) && seen.character->nullPoses == nullptr) {
            body.add(*seen.datagram, seen.sender->positionUnit(seen.header->type()));
        }
    }
}

void Content::takeMetadata(const wire::MetaData& message, const Observed& seen) {
    const log::Packet& packet = seen.packet;
    Metadata& metadata = seen.character->metadata;
    const std::size_t before = metadata.memoryBytes();
    metadata.add(message, packet.number, packet.stamp);
    if (auto changes = changesBy(metadata, packet.number); !changes.empty()) {
        m_incidents.takeChange(IncidentKind::MetadataChange, seen.character->key, packet,
                               {words::Kind::MetadataChanged, {{"changes", std::move(changes)}}});
    }
    if (m_metadataKeeping.grew(before, metadata.memoryBytes())) {
        std::vector<Metadata*> all;
        m_roll.characters().forEach([&all](Character& each) { all.push_back(&each.metadata); });
        m_metadataKeeping.keepWithin(all);
    }
}

void Content::takeNullPose(const wire::NullPose& part, const Observed& seen) {
    const log::Packet& packet = seen.packet;
    Character& character = *seen.character;
    character.nullPoses = character.nullPoses ? character.nullPoses : std::make_shared<NullPoseHistory>();
    NullPoseHistory& history = *character.nullPoses;
    const std::size_t before = history.memoryBytes();
    if (history.add(part, seen.header->datagramCounter, packet.number, packet.stamp)) {
        m_incidents.takeChange(IncidentKind::ScaleChange, character.key, packet, {});
    }
    // Once for each that differs, as soon as it is whole.
    const NullPoseRecord record = history.record(packet.number);
    const bool isWhole = record.pose != nullptr && record.pose->isComplete();
    if (isWhole && record.changed != std::exchange(character.judgedNullPose, record.changed)) {
        Occurrence one = Occurrence::at(IncidentKind::Scale, packet.sender, packet.stamp);
        one.character = character.key.character;
        one.detail = contradictionOf(record);
        character.isNullPoseUsable = one.detail.isNothing();
        m_incidents.takeCondition(std::move(one));
    }
    if (m_nullPoseKeeping.grew(before, history.memoryBytes())) {
        std::vector<NullPoseHistory*> all;
        m_roll.characters().forEach([&all](Character& each) {
            if (each.nullPoses != nullptr) {
                all.push_back(each.nullPoses.get());
            }
        });
        m_nullPoseKeeping.keepWithin(all);
    }
}

void Content::lookForContradictions(log::Stamp stamp) {
    if (stamp < m_nextContradictions) {
        return;
    }
    m_nextContradictions = stamp + kContradictions;
    for (const Sender& sender : std::as_const(m_roll).senders()) {
        if (sender.isPerforming()) {
            lookForFragments(sender, stamp);
            const auto found = m_roll.hasEnded(sender) ? std::vector<words::Fact>() : sender.contradictions();
            Occurrence one = Occurrence::at(IncidentKind::Scale, sender.id, stamp);
            if (!found.empty()) {
                one.detail = {words::Kind::Contradiction, {{"what", found.front()}}};
            }
            m_incidents.takeCondition(std::move(one));
        }
    }
    compareClocks(stamp);
    m_roll.characters().forEach([&](Character& each) { each.content.rest(each.key, stamp, m_incidents); });
}

/// Of hosts that all send the time of day: each with the one in the middle. What is a minute apart or more is
/// not of one time.
void Content::compareClocks(log::Stamp stamp) {
    constexpr int kLooks = 3;
    constexpr std::int32_t kApart = 500; // ms, more than a network takes
    constexpr std::int32_t kMost = 60'000;
    constexpr std::int32_t kLess = 20; // at a look: what arrives late is no other clock
    std::vector<Sender*> all;
    m_roll.senders().forEach([&](Sender& sender) {
        const auto seen = m_roll.hasEnded(sender) ? std::nullopt : clockAhead(sender);
        Sender::Clock& clock = sender.clock;
        const bool isNew = seen && std::exchange(clock.packet, seen->second) != seen->second;
        clock.looks = seen ? clock.looks + (isNew ? 1 : 0) : 0;
        if (isNew) {
            const std::int32_t before = std::exchange(clock.lookMs, seen->first);
            const std::int32_t both = std::min(clock.lookMs, before); // a damaged time code is in one alone
            clock.aheadMs = clock.looks > 2 ? std::max(both, clock.aheadMs - kLess) : both;
        }
        if (clock.looks >= kLooks) {
            all.push_back(&sender);
        }
    });
    if (all.size() < 2) {
        return;
    }
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>((all.size() - 1) / 2);
    std::ranges::nth_element(all, middle, {}, [](const Sender* one) { return one->clock.aheadMs; });
    for (Sender* sender : all) {
        const std::int32_t apart = sender->clock.aheadMs - (*middle)->clock.aheadMs;
        sender->clock.toldMs = std::abs(apart) < kApart / 2 ? 0 : sender->clock.toldMs;
        const bool isApart = std::abs(apart) > kApart && std::abs(apart) < kMost;
        if (isApart && std::abs(apart - sender->clock.toldMs) > kApart) {
            sender->clock.toldMs = apart;
            Occurrence one = Occurrence::at(IncidentKind::TimeCode, sender->id, stamp);
            one.detail = {words::Kind::ClocksApart,
                          {{"address", (*middle)->address().shown()},
                           {"value", words::Number{std::abs(apart) / 1000.0, 1}}}};
            m_incidents.report(one);
        }
    }
}

void Content::lookForFragments(const Sender& sender, log::Stamp stamp) {
    Occurrence one = Occurrence::at(IncidentKind::Fragments, sender.id, stamp);
    one.cause = LossCause::Network;
    const bool isPossible = m_kernel.lacksFragments() && !m_roll.hasEnded(sender);
    if (const auto missing = missingLargeTypes(sender); isPossible && !missing.empty()) {
        one.detail = {words::Kind::FragmentsLost,
                      {{"missing", words::typesFact(missing)}, {"cause", causeFact(LossCause::Network)}}};
    }
    m_incidents.takeCondition(std::move(one));
}

std::size_t Content::metadataBytes() const {
    const auto& all = std::as_const(m_roll).characters();
    return std::transform_reduce(all.begin(), all.end(), std::size_t{0}, std::plus(),
                                 [](const Character& each) { return each.metadata.memoryBytes(); });
}

std::size_t Content::nullPoseBytes() const {
    const auto& all = std::as_const(m_roll).characters();
    return std::transform_reduce(
        all.begin(), all.end(), std::size_t{0}, std::plus(),
        [](const Character& each) { return each.nullPoses ? each.nullPoses->memoryBytes() : 0; });
}

} // namespace posewire::model
