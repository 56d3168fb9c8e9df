// SPDX-License-Identifier: MIT
#include "core/model/session/ingest.h"

#include "core/model/body/pose_messages.h"
#include "core/wire/type_table.h"

#include <utility>

namespace posewire::model {
namespace {

/// Packets that are not older than this when they are followed are live: silence after them is silence.
constexpr log::Duration kLive = std::chrono::seconds(10);
/// Silence is looked at so often while it is short, then each time it is an eighth longer.
constexpr log::Duration kMoment = std::chrono::milliseconds(20);
constexpr log::Duration kShortSilence = std::chrono::seconds(5);
/// Then nothing is left that depends on when it is looked at.
constexpr log::Duration kLongSilence = std::chrono::minutes(1);

/// What is large is rare, or strange: whoever looks at it decodes it again.
bool keepsNewest(const log::Packet& packet, const wire::Header& header) {
    return countsSamples(header.type()) && packet.bytes.size() <= Ingest::kMostNewestBytes &&
           wire::findType(header.type()) != nullptr;
}

} // namespace

bool Ingest::follow(log::Stamp now, std::size_t most) {
    const std::size_t count = takeNew(now, most);
    m_isFile = false;
    if (count > 0 && now - m_observed < kLive && m_observed - now < kLive) {
        m_isLive = true; // also if its end is read late: this program was held up
    }
    if (m_isLive && !m_isHeldUp && m_follower.lag() == 0) {
        passTime(now);
        if (now - m_observed > kLongSilence) {
            m_counting.advance(now);
        }
    }
    return count > 0;
}

bool Ingest::followFile(log::Stamp now, std::size_t most) {
    m_isFile = true;
    return takeNew(now, most) > 0;
}

void Ingest::passTime(log::Stamp until) {
    until = std::min(until, m_observed + kLongSilence);
    while (m_moment <= until) {
        m_counting.advance(m_moment);
        const log::Duration silence = m_moment - m_observed;
        m_moment += silence < kShortSilence ? kMoment : silence / 8;
    }
}

log::Duration Ingest::behind() const {
    return m_isLive && m_follower.lag() != 0 ? std::max(m_now - m_observed, log::Duration())
                                             : log::Duration();
}

void Ingest::endFile() {
    m_isFile = true;
    m_isRead = true;
    m_isLive = false;
    settle();
    m_incidents.endFile();
}

void Ingest::setOverride(log::SenderId sender, const SenderOverride& overrides) {
    if (Sender* known = m_roll.senders().find(sender)) {
        known->overrides = overrides;
        m_content.lookAgain();
        m_content.lookForContradictions(m_observed);
    }
}

void Ingest::cutAt(log::Stamp edge, const TimeRange& read, std::uint64_t first, std::uint64_t end) {
    Ingest again(m_log, first);
    again.setEdges(m_roll.edges());
    again.takeNew(m_now, end - std::min(end, again.end()));
    again.settle();
    m_roll.streams().forEach([&](Stream& stream) {
        if (Stream* one = again.m_roll.streams().find(stream.key)) {
            stream.accounting.cutAt(edge, one->accounting, read);
        }
    });
    m_roll.senders().forEach([&](Sender& sender) {
        if (const Sender* one = again.m_roll.senders().find(sender.id)) {
            sender.history.cutAt(edge, one->history, read);
        }
    });
}

std::size_t Ingest::takeNew(log::Stamp now, std::size_t most) {
    m_now = now;
    m_follower.refresh();
    m_begin = m_follower.reader().begin();
    m_incidents.followClock(m_log.timeline());
    std::size_t count = 0;
    while (count < most) {
        const auto packet = m_follower.next();
        const log::DropSums unseen = m_follower.takeUnseen();
        m_dropRecordsUnseen += unseen.records;
        if (const std::uint64_t overtaken = m_follower.takeOvertaken(); overtaken > unseen.records) {
            m_counting.takeOvertaken(packet ? packet->number : m_follower.position(),
                                     overtaken - unseen.records, packet ? packet->stamp : m_now);
        }
        if (!packet) {
            break;
        }
        if (unseen.datagrams != 0) {
            m_dropsUnseen += unseen.datagrams;
            m_counting.takeDropsUnseen(unseen.datagrams, *packet);
        }
        take(*packet);
        ++count;
    }
    m_counting.dropBefore(m_begin);
    return count;
}

void Ingest::take(const log::Packet& packet) {
    if (!packet.flags.isFromBefore) {
        const bool isFirst = !std::exchange(m_isBegun, true);
        m_firstStamp = isFirst ? packet.stamp : m_firstStamp;
        // A computer that drops packets is held up: silence meanwhile is no evidence.
        if (!isFirst && packet.kernelDropsBefore == 0) {
            passTime(packet.stamp);
        }
        m_observed = packet.stamp;
        m_moment = packet.stamp + Counting::kUnderWay;
    }
    Observed seen{.packet = packet, .sender = m_roll.take(packet)};
    decode(seen);
    if (packet.flags.isFromBefore) {
        if (seen.sender != nullptr && seen.datagram != nullptr && enter(seen)) {
            m_counting.index(seen);
            m_content.take(seen);
        }
    } else if (seen.sender != nullptr) {
        m_counting.takePacket(seen);
        if (seen.datagram == nullptr) {
            m_counting.takeFaulty(seen);
        } else if (enter(seen)) {
            m_counting.takeDatagram(seen);
            m_content.take(seen);
            m_roll.findRenumbered(seen);
        } else {
            ++m_unfollowed;
        }
    }
    m_counting.close(seen);
    m_content.lookForContradictions(m_observed);
}

/// Decodes into the newest message of the stream, whose memory fits already.
void Ingest::decode(Observed& seen) {
    const log::Packet& packet = seen.packet;
    if (const auto header = wire::decodeHeader(packet.bytes); header && !packet.flags.skipped) {
        seen.header = *header;
        seen.stream = m_roll.streams().find({packet.sender, header->character, header->type()});
        if (seen.stream != nullptr) {
            seen.stream->newest.packet = UINT64_MAX;
        }
        const bool isKept = seen.stream != nullptr && keepsNewest(packet, *header);
        Message& into = isKept ? seen.stream->newest : m_unplaced;
        if (wire::decodeInto(packet.bytes, into.datagram)) {
            into.packet = packet.number;
            into.stamp = packet.stamp;
            into.sender = packet.sender;
            if (seen.sender != nullptr && header->datagramIndex() == 0) {
                seen.sender->detector.addBody(into.datagram.body);
            }
            turnUpright(into, seen.sender != nullptr ? seen.sender->up() : UpAxis::Z);
            seen.datagram = &into.datagram;
        }
    }
    seen.digest = digestOf(packet, seen.datagram);
}

/// False if there are too many streams or characters already.
bool Ingest::enter(Observed& seen) {
    const bool isKnown = seen.stream != nullptr;
    seen.sender->detector.addHeader(*seen.header);
    if (!m_roll.enter(seen)) {
        return false;
    }
    if (keepsNewest(seen.packet, *seen.header)) {
        if (!isKnown) {
            seen.stream->newest = m_unplaced; // no more of its memory than this one needs
        }
        seen.stream->newestBytes = std::max(seen.stream->newestBytes, seen.packet.bytes.size());
    }
    return true;
}

} // namespace posewire::model
