// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/field/field.h"
#include "core/filter/filter.h"
#include "core/log/recording_file.h"
#include "core/log/sender_table.h"
#include "core/log/timeline.h"

#include <string>
#include <string_view>
#include <unordered_map>

namespace posewire::cli {

/// The packets that the records of one file are, in order, with what is known about them.
class RecordPackets {
public:
    /// `number` is that of the packet, `stamp` that of a record without a time. What is returned is valid
    /// until the next call.
    [[nodiscard]] const field::Candidate& packetOf(const log::FileRecord& record, std::uint64_t number,
                                                   log::Stamp stamp = {});
    /// Returns when a record came that no packet is made of.
    log::Stamp stampOf(const log::FileRecord& record, log::Stamp stamp = {});
    /// The stamp of the first record.
    [[nodiscard]] log::Stamp firstStamp() const { return m_firstStamp.value_or(log::Stamp()); }
    [[nodiscard]] log::WallTime firstTime() const { return m_timeline.wallOf(firstStamp()); }

private:
    log::SenderId numberOf(const log::SenderInfo& sender);

    log::Timeline m_timeline;
    log::RecordedClock m_clock{m_timeline};
    model::PacketDigester m_digester;
    log::SenderTable m_senders;
    std::unordered_map<log::SenderId, log::SenderTable::Held> m_held;
    std::optional<log::SenderInfo> m_newestSender;
    std::optional<log::SenderId> m_newestId;
    wire::Datagram m_datagram;
    wire::WireError m_fault;
    log::Packet m_packet;
    model::PacketDigest m_digest;
    std::optional<field::Candidate> m_candidate;
    std::optional<log::Stamp> m_firstStamp;
};

/// Why a filter or signal was rejected, in three lines: the reason, the text, and a caret under the place.
[[nodiscard]] std::string markedError(std::string_view text, const filter::FilterError& error);

} // namespace posewire::cli
