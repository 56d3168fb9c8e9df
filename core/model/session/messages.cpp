// SPDX-License-Identifier: MIT
#include "core/model/session/messages.h"

#include "core/model/accounting/sample_window.h"
#include "core/model/accounting/stream_figures.h"
#include "core/model/body/null_pose_findings.h"
#include "core/model/session/decoded.h"
#include "core/model/session/ingest.h"
#include "core/wire/codec.h"

#include <algorithm>
#include <array>
#include <utility>

namespace posewire::model {
namespace {

/// Entries that are looked at for the parts of one sample: 128 indices, each at most twice.
constexpr std::size_t kPartSearch = 256;
/// What a message has in parts beyond these bytes is left out: no sender of ours needs a tenth of them, and
/// they are gathered again for each that asks.
constexpr std::size_t kMostPartBytes = 256 * 1024;
/// Decoded values, and the poses made of them, are about so much larger than what was sent.
constexpr std::size_t kPerKeptByte = 4;

bool isTooLarge(const log::Packet& packet) {
    const auto header = wire::decodeHeader(packet.bytes);
    return header && countsSamples(header->type()) && packet.bytes.size() > kMostMessageBytes;
}

/// Hands out the first datagram of each sample of a stream from a stamp on, at most the newest `most`; counts
/// those of which the visitor says that they were read.
template <class Visitor>
std::size_t visitFirsts(const Moment& moment, const log::StreamKey& key, log::Stamp fromStamp,
                        std::size_t most, Visitor&& visitor) {
    const log::StreamEntries* entries = moment.entriesOf(key);
    const std::size_t end = entries != nullptr ? moment.countOf(*entries) : 0;
    const auto before = end != 0 ? entries->atOrBeforeStamp(fromStamp - log::Duration(1)) : std::nullopt;
    std::size_t visited = 0;
    for (std::size_t i = std::max(before ? *before + 1 : 0, end > most ? end - most : 0); i < end; ++i) {
        const log::StreamEntry& entry = (*entries)[i];
        visited += entry.datagram == 0 && visitor(entry) ? 1 : 0;
    }
    return visited;
}

/// Returns how many of the first `count` entries there are up to the newest sample: a few that are whole in a
/// datagram may have come late, after it.
std::size_t upToNewest(const log::StreamEntries& entries, std::size_t count) {
    constexpr std::size_t kMostLate = 8;
    constexpr std::int32_t kFarthest = 4'096; // else the counter was set back
    std::size_t end = count;
    for (std::size_t i = count; i-- > (count > kMostLate ? count - kMostLate : 0);) {
        const std::int32_t ahead = distance(entries[i].sample, entries[end - 1].sample);
        const bool isWhole = entries[i].isLast && entries[i].datagram == 0;
        end = isWhole && ahead > 0 && ahead <= kFarthest ? i + 1 : end;
    }
    return end;
}

} // namespace

Messages::Messages(const Moment& moment, const Roster& roster)
    : m_moment(moment), m_roster(roster), m_decoded(std::make_unique<Decoded>()) {}

Messages::~Messages() = default;

std::size_t Messages::memoryBytes() const {
    return kPerKeptByte * m_decoded->bytes;
}

Messages::Decoded& Messages::decoded() const {
    const std::uint64_t end = m_moment.ingest().end();
    const std::uint64_t retired = m_moment.ingest().roll().retired().senders;
    const bool hasFollowed = std::exchange(m_decoded->end, end) != end;
    const bool hasRetired = std::exchange(m_decoded->retired, retired) != retired;
    const bool isMuch = hasFollowed && kPerKeptByte * m_decoded->bytes > kMostDecodedBytes / 4;
    if (hasRetired || isMuch) {
        m_decoded->messages.clear();
        m_decoded->characters.clear();
        m_decoded->bytes = 0;
    }
    return *m_decoded;
}

bool Messages::readWhole(const log::StreamEntry& entry, Message& message) const {
    const auto packet = m_moment.packet(entry.packet);
    if (!packet || isTooLarge(*packet) || !wire::decodeInto(packet->bytes, message.datagram)) {
        return false;
    }
    message.stamp = packet->stamp;
    message.packet = entry.packet;
    message.sender = packet->sender;
    turnUpright(message, m_roster.up(packet->sender));
    m_decoded->bytes += &message == &m_decoded->visited ? 0 : packet->bytes.size();
    return true;
}

/// The newest sample among the first `count` entries whose datagrams are all there.
bool Messages::readMessage(const log::StreamEntries& entries, std::size_t count, Message& message) const {
    const std::size_t oldest = count > kPartSearch ? count - kPartSearch : 0;
    for (std::size_t i = count; i-- > oldest;) {
        const log::StreamEntry& last = entries[i];
        if (!last.isLast) {
            continue;
        }
        if (last.datagram == 0) {
            return readWhole(last, message);
        }
        std::array<std::size_t, 128> places{};
        std::size_t present = 0;
        const std::size_t end = std::min(count, i + kPartSearch);
        for (std::size_t k = oldest; k < end; ++k) {
            if (entries[k].sample == last.sample && entries[k].datagram <= last.datagram) {
                std::size_t& place = places[entries[k].datagram];
                present += place == 0 ? 1 : 0;
                place = k + 1;
            }
        }
        if (present != last.datagram + std::size_t{1} || !readWhole(entries[places[0] - 1], message)) {
            continue;
        }
        const bool isSampled = countsSamples(message.datagram.header.type());
        const std::size_t most = isSampled ? kMostMessageBytes : kMostPartBytes;
        std::size_t bytes = 0;
        for (std::size_t part = 1; part <= last.datagram && bytes <= most; ++part) {
            const auto packet = m_moment.packet(entries[places[part] - 1].packet);
            bytes += packet ? packet->bytes.size() : 0;
            if (readWhole(entries[places[part] - 1], m_decoded->part)) {
                appendPart(message.datagram, m_decoded->part.datagram);
            }
        }
        message.packet = last.packet;
        message.stamp = last.stamp;
        return true;
    }
    return false;
}

const Message* Messages::message(const CharacterKey& key, std::uint8_t type) const {
    const log::StreamKey streamKey{key.sender, key.character, type};
    const log::StreamEntries* stream = m_moment.entriesOf(streamKey);
    const std::size_t count = stream != nullptr ? upToNewest(*stream, m_moment.countOf(*stream)) : 0;
    if (count == 0) {
        const Character* before = m_roster.predecessor(key);
        return before != nullptr ? message(before->key, type) : nullptr;
    }
    const log::StreamEntry& newest = (*stream)[count - 1];
    if (newest.isLast && newest.datagram == 0) {
        const Stream* ingested = m_roster.find(streamKey);
        if (ingested != nullptr && ingested->newest.packet == newest.packet &&
            ingested->newest.isSentYUp == (m_roster.up(key.sender) == UpAxis::Y)) {
            return &ingested->newest;
        }
    }
    Decoded::OfStream& read = decoded().messages[streamKey];
    if (read.packet != newest.packet ||
        (read.isValid && read.message.isSentYUp != (m_roster.up(key.sender) == UpAxis::Y))) {
        read.isValid = readMessage(*stream, count, read.message);
        read.packet = newest.packet;
    }
    return read.isValid ? &read.message : nullptr;
}

std::size_t Messages::visit(const log::StreamKey& key, log::Stamp fromStamp, std::size_t most,
                            const std::function<void(const Message&)>& visitor) const {
    return visitFirsts(m_moment, key, fromStamp, most, [&](const log::StreamEntry& entry) {
        const bool isRead = entry.isLast && readWhole(entry, m_decoded->visited);
        if (isRead) {
            visitor(m_decoded->visited);
        }
        return isRead;
    });
}

std::size_t
Messages::visitHeaders(const log::StreamKey& key, log::Stamp fromStamp, std::size_t most,
                       const std::function<void(log::Stamp, const wire::Header&)>& visitor) const {
    return visitFirsts(m_moment, key, fromStamp, most, [&](const log::StreamEntry& entry) {
        const auto packet = m_moment.packet(entry.packet);
        const auto header = packet ? wire::decodeHeader(packet->bytes) : tl::unexpected(wire::WireError{});
        if (header) {
            visitor(packet->stamp, *header);
        }
        return header.has_value();
    });
}

void Messages::addArrivals(const log::StreamKey& key, const RangeParts& parts, std::size_t most,
                           std::span<RangePart> into) const {
    const log::StreamEntries* entries = m_moment.entriesOf(key);
    const auto last = entries != nullptr && parts.count != 0
                          ? entries->atOrBeforeStamp(parts.beginOf(parts.count) - log::Duration(1))
                          : std::nullopt;
    if (!last) {
        return;
    }
    const auto before = entries->atOrBeforeStamp(parts.first - log::Duration(1));
    const std::size_t first = before ? *before + 1 : 0;
    if (*last + 1 - first > most) {
        return;
    }
    for (std::size_t i = first; i <= *last; ++i) {
        const log::StreamEntry& entry = (*entries)[i];
        RangePart& part = into[static_cast<std::size_t>((entry.stamp - parts.first) / parts.width)];
        ++part.datagrams;
        part.samples += entry.isLast ? 1 : 0;
    }
}

log::Stamp Messages::newestStamp(const log::StreamKey& key) const {
    const log::StreamEntries* stream = m_moment.entriesOf(key);
    const std::size_t count = stream != nullptr ? m_moment.countOf(*stream) : 0;
    const auto newest = count != 0 ? m_moment.packet((*stream)[count - 1].packet) : std::nullopt;
    return newest ? newest->stamp : log::Stamp();
}

std::optional<std::uint64_t> Messages::packetOfSample(const log::StreamKey& key, int steps) const {
    const log::StreamEntries* entries = m_moment.entriesOf(key);
    if (entries == nullptr || entries->empty()) {
        return std::nullopt;
    }
    const auto isSameSample = [&](std::size_t one, std::size_t other) {
        return (*entries)[one].sample == (*entries)[other].sample;
    };
    std::size_t place = m_moment.countOf(*entries);
    if (place == 0) { // before all of them: the first is one step on
        place = 1;
        steps -= steps > 0 ? 1 : 0;
    }
    --place;
    for (; steps < 0; ++steps) {
        const std::size_t from = place;
        while (place > 0 && isSameSample(place, from)) {
            --place;
        }
    }
    for (; steps >= 0; --steps) { // up to the end of this sample, then to the end of the next
        while (place + 1 < entries->size() && isSameSample(place + 1, place)) {
            ++place;
        }
        place += steps > 0 && place + 1 < entries->size() ? 1 : 0;
    }
    return (*entries)[place].packet;
}

std::optional<std::uint64_t> Messages::firstSample(const log::StreamKey& key) const {
    const log::StreamEntries* entries = m_moment.entriesOf(key);
    if (entries == nullptr || entries->empty()) {
        return std::nullopt;
    }
    std::size_t place = 0;
    while (place + 1 < entries->size() && (*entries)[place + 1].sample == (*entries)[0].sample) {
        ++place;
    }
    return (*entries)[place].packet;
}

std::vector<std::uint64_t> Messages::wholeBefore(const log::StreamKey& key, std::uint64_t packet) const {
    const log::StreamEntries* entries = m_moment.entriesOf(key);
    const auto place =
        entries != nullptr && packet != 0 ? entries->atOrBeforePacket(packet - 1) : std::nullopt;
    std::vector<std::uint64_t> parts;
    log::Stamp since{};
    for (std::size_t i = place ? *place + 1 : 0; i-- != 0;) {
        const log::StreamEntry& entry = (*entries)[i];
        if (entry.isLast) {
            parts.assign(std::size_t{entry.datagram} + 1, UINT64_MAX);
            since = entry.stamp - MessageRounds::kTogether;
        } else if (entry.stamp < since) {
            parts.clear();
        }
        if (entry.datagram < parts.size()) {
            parts[entry.datagram] = entry.packet;
        }
        if (!parts.empty() && std::ranges::count(parts, UINT64_MAX) == 0) {
            return parts;
        }
    }
    return {};
}

double Messages::ageSeconds(const CharacterKey& key) const {
    const Character* character = m_roster.find(key);
    if (character == nullptr) {
        return 0;
    }
    log::Stamp newest = character->lastStamp;
    if (m_moment.isPaused()) {
        newest = {};
        for (const Stream* stream : character->streams) {
            const log::StreamEntries* list = m_moment.entriesOf(stream->key);
            const std::size_t count = list != nullptr ? m_moment.countOf(*list) : 0;
            newest = count != 0 ? std::max(newest, (*list)[count - 1].stamp) : newest;
        }
    }
    return std::max(0.0, log::secondsOf(m_moment.stamp() - newest));
}

const Metadata& Messages::metadata(const CharacterKey& key) const {
    static const Metadata none;
    const Character* character = m_roster.find(key);
    for (const Character* other = character; other != nullptr; other = m_roster.predecessor(other->key)) {
        if (!other->metadata.tags().empty()) {
            return other->metadata;
        }
    }
    return character != nullptr ? character->metadata : none;
}

const NullPose* Messages::nullPose(const CharacterKey& key) const {
    const Character* character = m_roster.find(key);
    const NullPoseHistory* history = character != nullptr ? character->nullPoses.get() : nullptr;
    const std::uint64_t end = m_moment.end();
    const NullPose* pose = history != nullptr && end != 0 ? history->at(end - 1) : nullptr;
    const Character* before = pose == nullptr ? m_roster.predecessor(key) : nullptr;
    return before != nullptr ? nullPose(before->key) : pose;
}

NullPoseEvidence Messages::nullPoseEvidence(const CharacterKey& key) const {
    NullPoseEvidence evidence;
    evidence.now = m_moment.stamp();
    const std::uint64_t end = m_moment.end();
    for (const Character* character = m_roster.find(key);
         character != nullptr && evidence.record.messages == 0;
         character = m_roster.predecessor(character->key)) {
        if (const NullPoseHistory* history = character->nullPoses.get()) {
            evidence.record = history->record(end == 0 ? 0 : end - 1);
        }
    }
    if (const Message* sent = message(key, wire::ScaleInformation::kType)) {
        evidence.scale = std::get_if<wire::ScaleInformation>(&sent->datagram.body);
    }
    if (const CharacterPose* newest = pose(key)) {
        evidence.layout = newest->layout;
        if (const Stream* stream = m_roster.find(log::StreamKey{key.sender, key.character, newest->type})) {
            evidence.poseSeconds = log::secondsOf(newest->stamp - stream->accounting.firstStamp());
        }
    }
    return evidence;
}

} // namespace posewire::model
