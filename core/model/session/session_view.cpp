// SPDX-License-Identifier: MIT
#include "core/model/session/session_view.h"

#include "core/model/accounting/attribution.h"
#include "core/model/accounting/range_figures.h"
#include "core/model/body/null_pose_findings.h"
#include "core/model/incidents/incident_follower.h"
#include "core/model/session/decoded.h"
#include "core/wire/codec.h"

#include <algorithm>
#include <array>
#include <utility>

namespace posewire::model {
namespace {

/// Entries that are looked at for the parts of one sample: 128 indices, each at most twice.
constexpr std::size_t kPartSearch = 256;
/// What a message has in parts beyond these bytes is left out: no sender of ours needs a tenth of them, and
/// gathering is done anew for each that asks.
constexpr std::size_t kMostPartBytes = 256 * 1024;
/// Decoded values, and the poses made of them, are about so much larger than what was sent.
constexpr std::size_t kPerKeptByte = 4;

bool isTooLarge(const log::Packet& packet) {
    const auto header = wire::decodeHeader(packet.bytes);
    return header && countsSamples(header->type()) && packet.bytes.size() > kMostMessageBytes;
}

/// One past the last packet before a stamp. Where packets are missing, the next one that is there counts.
std::uint64_t endBefore(Ingest& ingest, log::Stamp stamp) {
    std::uint64_t first = ingest.begin();
    std::uint64_t last = ingest.end();
    while (first < last) {
        const std::uint64_t middle = first + (last - first) / 2;
        const auto packet = ingest.reader().packetFrom(middle);
        if (packet && packet->number < last && packet->stamp < stamp) {
            first = packet->number + 1;
        } else {
            last = middle;
        }
    }
    return first;
}

} // namespace

SessionView::SessionView(Ingest& ingest, const Choices& choices)
    : m_ingest(ingest),
      m_choices(choices),
      m_decoded(std::make_unique<Decoded>()),
      m_judged(newJudged()),
      m_ownNow(new SessionView(*this, Now{})),
      m_atNow(m_ownNow.get()) {}

SessionView::SessionView(const SessionView& other, Now)
    : m_ingest(other.m_ingest),
      m_choices(other.m_choices),
      m_decoded(std::make_unique<Decoded>()),
      m_judged(other.m_judged),
      m_atNow(this) {}

SessionView::~SessionView() = default;

const Incidents& SessionView::incidents() const {
    return m_ingest.incidents().incidents();
}

const Thresholds& SessionView::thresholds() const {
    return m_ingest.incidents().thresholds();
}

const std::deque<Gap>& SessionView::gaps() const {
    return m_ingest.attribution().gaps();
}

void SessionView::forEachPending(const std::function<void(const PendingLoss&)>& f) const {
    m_ingest.attribution().forEachPending(f);
}

void SessionView::forEachPartialLoss(
    const std::function<void(const log::StreamKey&, log::Stamp, LossCause, std::uint64_t)>& f) const {
    m_ingest.attribution().forEachPartialLoss(f);
}

log::Stamp SessionView::judgedUntil() const {
    return knownUntil() - m_ingest.attribution().patience();
}

std::uint64_t SessionView::provisionalNumber(log::SenderId sender) const {
    return m_ingest.provisionalNumber(sender);
}

const Gap* SessionView::gapEndedBy(std::uint64_t packet) const {
    return m_ingest.attribution().endedBy(packet);
}

std::uint64_t SessionView::settledEnd() const {
    constexpr log::Duration kLongest = std::chrono::seconds(1); // what stays open is not waited for
    const log::Stamp after = now() - kLongest;
    std::uint64_t end = std::min(digests().end(), m_ingest.attribution().firstPending(after));
    for (const Stream& stream : streams()) {
        if (stream.accounting.lastStamp() > after) {
            end = std::min(end, stream.accounting.firstInDoubt());
        }
    }
    return std::max(end, digests().begin());
}

SenderTotals SessionView::allSenders() const {
    SenderTotals sums = retired();
    for (const Sender& sender : senders()) {
        sums.add(sender);
    }
    sums.kernelDrops += m_ingest.dropsUnseen();
    return sums;
}

StreamCounts SessionView::countsOf(const CharacterKey& key, const TimeRange& range) const {
    StreamCounts sum;
    if (const Character* character = find(key)) {
        for (const Stream* stream : character->streams) {
            sum += stream->accounting.countsBetween(range.from, range.to);
        }
    }
    return sum;
}

MemoryFigures SessionView::memory() const {
    MemoryFigures figures = m_ingest.memory();
    const auto messages = std::ranges::find(figures.parts, "messages", &MemoryFigures::Part::key);
    messages->bytes += kPerKeptByte * (m_decoded->bytes + (m_atNow != this ? m_atNow->m_decoded->bytes : 0));
    return figures;
}

SessionView::Decoded& SessionView::decoded() const {
    const bool hasFollowed = std::exchange(m_decoded->end, end()) != end();
    const bool hasRetired = std::exchange(m_decoded->retired, retired().senders) != retired().senders;
    const bool isMuch = hasFollowed && kPerKeptByte * m_decoded->bytes > kMostDecodedBytes / 4;
    if (hasRetired || isMuch) {
        m_decoded->messages.clear();
        m_decoded->characters.clear();
        m_decoded->bytes = 0;
    }
    return *m_decoded;
}

std::uint64_t SessionView::packetFrom(log::Stamp stamp) const {
    const auto packet = m_ingest.reader().packetFrom(endBefore(m_ingest, stamp));
    return packet ? std::min(packet->number, end()) : end();
}

std::uint64_t SessionView::packetAt(log::Stamp stamp) const {
    const std::uint64_t after = endBefore(m_ingest, stamp + log::Duration(1));
    return after == begin() ? after : after - 1;
}

std::optional<std::uint64_t> SessionView::packetOfSample(const log::StreamKey& key, int steps) const {
    const log::StreamEntries* entries = m_ingest.index().find(key);
    if (entries == nullptr || entries->empty()) {
        return std::nullopt;
    }
    const auto isSameSample = [&](std::size_t one, std::size_t other) {
        return (*entries)[one].sample == (*entries)[other].sample;
    };
    std::size_t place = visibleCount(*entries);
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

std::optional<TimeRange> SessionView::range() const {
    if (rangeChoice().isSinceReset) {
        return TimeRange{reset(), std::max(reset(), cursorStamp() + log::Duration(1))};
    }
    if (rangeChoice().fixed || rangeChoice().last <= log::Duration::zero()) {
        return rangeChoice().fixed;
    }
    // What arrives at this very moment belongs to it.
    const log::Stamp end = cursorStamp() + log::Duration(1);
    return TimeRange{end - rangeChoice().last, end};
}

log::Stamp SessionView::cursorStamp() const {
    if (!isPaused()) {
        return now();
    }
    const auto packet = this->packet(cursor().packet);
    return packet ? packet->stamp : now();
}

std::uint64_t SessionView::visibleEnd() const {
    return isPaused() ? std::min(end(), cursor().packet + 1) : end();
}

std::optional<log::Stamp> SessionView::pausedStamp() const {
    return isPaused() ? std::optional(cursorStamp()) : std::nullopt;
}

std::vector<const Incident*> SessionView::troublesOf(const CharacterKey& key) const {
    return m_ingest.incidents().troublesOf(key, pausedStamp());
}

const Metadata& SessionView::metadata(const CharacterKey& key) const {
    static const Metadata none;
    const Character* character = find(key);
    for (const Character* other = character; other != nullptr; other = predecessor(other->key)) {
        if (!other->metadata.tags().empty()) {
            return other->metadata;
        }
    }
    return character != nullptr ? character->metadata : none;
}

const ForeignText& SessionView::metadataValue(const CharacterKey& key, std::string_view tag) const {
    static const ForeignText none;
    const Character* character = find(key);
    const std::uint64_t end = visibleEnd();
    const ForeignText& value =
        character != nullptr && end != 0 ? character->metadata.value(tag, end - 1) : none;
    const Character* before = value.isEmpty() ? predecessor(key) : nullptr;
    return before != nullptr ? metadataValue(before->key, tag) : value;
}

Colour SessionView::colour(const CharacterKey& key) const {
    const auto sent = parseColour(metadataValue(key, "color").shown());
    const Character* character = find(key);
    return sent ? *sent : defaultColour(character != nullptr ? character->ordinal : 0);
}

double SessionView::ageSeconds(const CharacterKey& key) const {
    const Character* character = find(key);
    if (character == nullptr) {
        return 0;
    }
    log::Stamp newest = character->lastStamp;
    if (isPaused()) {
        newest = {};
        for (const Stream* stream : character->streams) {
            const log::StreamEntries* list = m_ingest.index().find(stream->key);
            const std::size_t count = list != nullptr ? visibleCount(*list) : 0;
            newest = count != 0 ? std::max(newest, (*list)[count - 1].stamp) : newest;
        }
    }
    return std::max(0.0, log::secondsOf(cursorStamp() - newest));
}

/// Entries of packets that the cursor has reached.
std::size_t SessionView::visibleCount(const log::StreamEntries& entries) const {
    const std::uint64_t end = visibleEnd();
    if (end == 0) {
        return 0;
    }
    const auto newest = entries.atOrBeforePacket(end - 1);
    return newest ? *newest + 1 : 0;
}

bool SessionView::readWhole(const log::StreamEntry& entry, Message& message) const {
    const auto packet = this->packet(entry.packet);
    if (!packet || isTooLarge(*packet) || !wire::decodeInto(packet->bytes, message.datagram)) {
        return false;
    }
    message.stamp = packet->stamp;
    message.packet = entry.packet;
    message.sender = packet->sender;
    m_decoded->bytes += &message == &m_decoded->visited ? 0 : packet->bytes.size();
    return true;
}

/// The newest sample among the first `count` entries whose datagrams are all there.
bool SessionView::readMessage(const log::StreamEntries& entries, std::size_t count, Message& message) const {
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
            const auto packet = this->packet(entries[places[part] - 1].packet);
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

const Message* SessionView::message(const CharacterKey& key, std::uint8_t type) const {
    const log::StreamKey streamKey{key.sender, key.character, type};
    const log::StreamEntries* stream = m_ingest.index().find(streamKey);
    const std::size_t count = stream != nullptr ? visibleCount(*stream) : 0;
    if (count == 0) {
        const Character* before = predecessor(key);
        return before != nullptr ? message(before->key, type) : nullptr;
    }
    const log::StreamEntry& newest = (*stream)[count - 1];
    if (newest.isLast && newest.datagram == 0) {
        const Message* ingested = m_ingest.newest(streamKey);
        if (ingested != nullptr && ingested->packet == newest.packet) {
            return ingested;
        }
    }
    Decoded::OfStream& read = decoded().messages[streamKey];
    if (read.packet != newest.packet) {
        read.isValid = readMessage(*stream, count, read.message);
        read.packet = newest.packet;
    }
    return read.isValid ? &read.message : nullptr;
}

/// Hands out the first datagram of each sample; counts those of which the visitor says that they were read.
template <class Visitor>
std::size_t SessionView::visitFirsts(const log::StreamKey& key, log::Stamp fromStamp, std::size_t most,
                                     Visitor&& visitor) const {
    const log::StreamEntries* stream = m_ingest.index().find(key);
    const std::size_t count = stream != nullptr ? visibleCount(*stream) : 0;
    if (count == 0) {
        return 0;
    }
    const auto before = stream->atOrBeforeStamp(fromStamp - log::Duration(1));
    std::size_t visited = 0;
    for (std::size_t i = std::max(before ? *before + 1 : 0, count > most ? count - most : 0); i < count;
         ++i) {
        const log::StreamEntry& entry = (*stream)[i];
        visited += entry.datagram == 0 && visitor(entry) ? 1 : 0;
    }
    return visited;
}

std::size_t SessionView::visit(const log::StreamKey& key, log::Stamp fromStamp, std::size_t most,
                               const std::function<void(const Message&)>& visitor) const {
    return visitFirsts(key, fromStamp, most, [&](const log::StreamEntry& entry) {
        const bool isRead = entry.isLast && readWhole(entry, m_decoded->visited);
        if (isRead) {
            visitor(m_decoded->visited);
        }
        return isRead;
    });
}

std::size_t
SessionView::visitHeaders(const log::StreamKey& key, log::Stamp fromStamp, std::size_t most,
                          const std::function<void(log::Stamp, const wire::Header&)>& visitor) const {
    return visitFirsts(key, fromStamp, most, [&](const log::StreamEntry& entry) {
        const auto packet = this->packet(entry.packet);
        const auto header = packet ? wire::decodeHeader(packet->bytes) : tl::unexpected(wire::WireError{});
        if (header) {
            visitor(packet->stamp, *header);
        }
        return header.has_value();
    });
}

void SessionView::addArrivals(const log::StreamKey& key, const RangeParts& parts, std::size_t most,
                              std::span<RangePart> into) const {
    const log::StreamEntries* entries = m_ingest.index().find(key);
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

log::Stamp SessionView::newestStamp(const log::StreamKey& key) const {
    const log::StreamEntries* stream = m_ingest.index().find(key);
    const std::size_t count = stream != nullptr ? visibleCount(*stream) : 0;
    const auto newest = count != 0 ? packet((*stream)[count - 1].packet) : std::nullopt;
    return newest ? newest->stamp : log::Stamp();
}

const NullPose* SessionView::nullPose(const CharacterKey& key) const {
    const NullPoseHistory* history = nullPoses(key);
    const std::uint64_t end = visibleEnd();
    const NullPose* pose = history != nullptr && end != 0 ? history->at(end - 1) : nullptr;
    const Character* before = pose == nullptr ? predecessor(key) : nullptr;
    return before != nullptr ? nullPose(before->key) : pose;
}

NullPoseEvidence SessionView::nullPoseEvidence(const CharacterKey& key) const {
    NullPoseEvidence evidence;
    evidence.now = cursorStamp();
    const std::uint64_t end = visibleEnd();
    for (const Character* character = find(key); character != nullptr && evidence.record.messages == 0;
         character = predecessor(character->key)) {
        if (const NullPoseHistory* history = nullPoses(character->key)) {
            evidence.record = history->record(end == 0 ? 0 : end - 1);
        }
    }
    if (const Message* sent = message(key, wire::ScaleInformation::kType)) {
        evidence.scale = std::get_if<wire::ScaleInformation>(&sent->datagram.body);
    }
    if (const CharacterPose* newest = pose(key)) {
        evidence.layout = newest->layout;
        if (const Stream* stream = find(log::StreamKey{key.sender, key.character, newest->type})) {
            evidence.poseSeconds = log::secondsOf(newest->stamp - stream->accounting.firstStamp());
        }
    }
    return evidence;
}

} // namespace posewire::model
