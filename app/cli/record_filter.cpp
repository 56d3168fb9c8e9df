// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/record_filter.h"

#include <algorithm>

namespace posewire::cli {
namespace {

/// Counts characters, not bytes, so that the caret is in the right place.
std::size_t charactersOf(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char byte) {
        return (static_cast<unsigned char>(byte) & 0xc0) != 0x80;
    }));
}

} // namespace

bool RecordFilter::matches(const log::FileRecord& record, std::uint64_t index) {
    log::Packet packet;
    packet.number = index;
    packet.bytes = record.bytes;
    packet.stamp = record.stamp.value_or(log::Stamp());
    packet.flags = record.flags;
    packet.kernelDropsBefore = record.kernelDropsBefore;
    packet.sender = m_senders.intern(record.sender.value_or(log::SenderInfo{"", log::Transport::File, 0}));
    m_firstStamp = m_firstStamp.value_or(packet.stamp);
    const auto decoded =
        record.flags.skipped ? tl::unexpected(wire::WireError{}) : wire::decodeInto(record.bytes, m_datagram);
    const wire::Datagram* datagram = decoded ? &m_datagram : nullptr;
    const model::PacketDigest digest = m_digester.add(packet, datagram);
    return m_filter.matches({packet, digest, datagram,
                             record.sender ? m_senders.find(packet.sender) : nullptr, *m_firstStamp,
                             decoded ? nullptr : &decoded.error()});
}

std::string markedError(std::string_view text, const filter::FilterError& error) {
    std::string line(text);
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c == '\n' || c == '\t' || c == '\r'; }, ' ');
    const std::size_t before = charactersOf(text.substr(0, error.offset));
    const std::size_t marked =
        std::max<std::size_t>(1, charactersOf(text.substr(error.offset, error.length)));
    return "--filter: " + error.text + "\n  " + line + "\n  " + std::string(before, ' ') +
           std::string(marked, '^');
}

} // namespace posewire::cli
