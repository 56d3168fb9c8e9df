// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/chunk_history.h"
#include "core/log/packet.h"
#include "core/log/past.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace posewire::log {

class PacketLog;

/// A steady look at a PacketLog: begin() and end() move only in refresh(), whatever the writer does
/// meanwhile. Each thread has a reader of its own; a reader is cheap, and must not outlive its log.
///
/// The bytes of a packet stay valid until the next refresh() or the end of the reader, also where the log
/// drops them meanwhile: what was looked at is held, chunk by chunk. A packet that was not looked at may be
/// gone. Of packets that lie in files those are held that were looked at last: PastReader::kHeld.
class LogReader {
public:
    explicit LogReader(const PacketLog& log);

    /// Moves on to what the log holds now and lets go of what was looked at. True if there are new packets.
    bool refresh();

    /// Number of the oldest packet there was at the last refresh().
    [[nodiscard]] std::uint64_t begin() const { return m_begin; }
    /// One past the newest packet there was at the last refresh().
    [[nodiscard]] std::uint64_t end() const { return m_end; }

    /// Nothing where the number is outside [begin, end), the log has dropped the packet since the last
    /// refresh(), or it was dropped from memory before it was written to a file.
    [[nodiscard]] std::optional<Packet> packet(std::uint64_t number) {
        if (number - m_currentFirst < m_currentCount) {
            return view(number);
        }
        return packetElsewhere(number);
    }

    /// What this computer dropped before a packet, or before what comes next. Nothing where the packet is not
    /// there any more, or nobody knows.
    [[nodiscard]] std::optional<DropSums> dropsBefore(std::uint64_t number);

    /// The packet of that number, or else the next one that is there.
    [[nodiscard]] std::optional<Packet> packetFrom(std::uint64_t number);

private:
    std::optional<Packet> packetElsewhere(std::uint64_t number);
    [[nodiscard]] bool enterChunk(std::uint64_t number);
    [[nodiscard]] std::optional<DropSums> dropsBeforeInPast(std::uint64_t number) const;

    [[nodiscard]] Packet view(std::uint64_t number) const {
        const Record& record = m_current->record(static_cast<std::size_t>(number - m_currentFirst));
        return {number,        record.stamp,
                record.sender, record.kernelDropsBefore,
                record.flags,  {record.data, record.size}};
    }

    const ChunkHistory* m_history;
    const Past* m_past;
    PastReader m_pastReader;
    std::uint64_t m_begin = 0;
    std::uint64_t m_end = 0;
    std::uint64_t m_version = 0;
    std::vector<ChunkHistory::Entry> m_entries;
    std::map<std::uint64_t, std::shared_ptr<const Chunk>> m_held; ///< what was looked at, by first packet

    const Chunk* m_current = nullptr; ///< the chunk of the last packet looked at
    std::uint64_t m_currentFirst = 0;
    std::uint64_t m_currentCount = 0;
    DropSums m_currentDrops; ///< before its first packet
};

} // namespace posewire::log
