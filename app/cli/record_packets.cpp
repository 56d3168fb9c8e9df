// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/record_packets.h"

#include "app/cli/table_writer.h"
#include "core/wire/codec.h"

#include <algorithm>

namespace posewire::cli {

log::Stamp RecordPackets::stampOf(const log::FileRecord& record, log::Stamp stamp) {
    stamp = record.time ? m_clock.stampOf(*record.time, record.setBy) : stamp;
    m_firstStamp = m_firstStamp.value_or(stamp);
    return stamp;
}

const field::Candidate& RecordPackets::packetOf(const log::FileRecord& record, std::uint64_t number,
                                                log::Stamp stamp) {
    m_packet = {};
    m_packet.number = number;
    m_packet.bytes = record.bytes;
    m_packet.stamp = stampOf(record, stamp);
    m_packet.flags = record.flags;
    m_packet.kernelDropsBefore = record.kernelDropsBefore;
    if (!m_newestId || record.sender != m_newestSender) {
        m_newestSender = record.sender;
        m_newestId = numberOf(record.sender.value_or(log::SenderInfo{"", log::Transport::File, 0}));
    }
    m_packet.sender = *m_newestId;
    const auto decoded =
        record.flags.skipped ? tl::unexpected(wire::WireError{}) : wire::decodeInto(record.bytes, m_datagram);
    m_fault = decoded ? wire::WireError{} : decoded.error();
    const wire::Datagram* datagram = decoded ? &m_datagram : nullptr;
    m_digest = m_digester.add(m_packet, datagram);
    m_candidate.emplace(field::Candidate{
        m_packet, m_digest, datagram, record.sender ? &*record.sender : nullptr, firstStamp(),
        decoded ? nullptr : &m_fault, m_timeline.setByAt(m_packet.stamp), std::nullopt, m_digester.stream()});
    return *m_candidate;
}

/// Returns one number for each sender, as long as there are not too many.
log::SenderId RecordPackets::numberOf(const log::SenderInfo& sender) {
    constexpr std::size_t kMostSenders = 65'536;
    const log::SenderId id = m_senders.intern(sender);
    if (m_held.size() < kMostSenders && !m_held.contains(id)) {
        m_held.emplace(id, m_senders.find(id));
    }
    return id;
}

std::string markedError(std::string_view text, const filter::FilterError& error) {
    std::string line(text);
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == '\n' || c == '\t' || c == '\r'; }, ' ');
    const std::size_t before = widthOf(text.substr(0, error.offset));
    const std::size_t marked = std::max<std::size_t>(1, widthOf(text.substr(error.offset, error.length)));
    return error.text + "\n  " + line + "\n  " + std::string(before, ' ') + std::string(marked, '^');
}

} // namespace posewire::cli
