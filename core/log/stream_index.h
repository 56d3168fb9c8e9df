// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/log_reader.h"
#include "core/log/packet.h"
#include "core/log/stream_key.h"
#include "core/log/time.h"
#include "core/wire/header.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace posewire::log {

/// One datagram of a stream.
struct StreamEntry {
    std::uint64_t packet = 0; ///< its number in the log
    Stamp stamp{}; ///< the packet's, but never before that of the entry before: clocks may be set back
    std::uint32_t sample = 0;  ///< sample counter
    std::uint8_t datagram = 0; ///< index of the datagram within its sample
    bool isLast = false;       ///< the last one of its sample
};

/// The entries of one stream, oldest first. Memory is taken and given back in blocks.
class StreamEntries {
public:
    static constexpr std::size_t kBlock = 256;
    struct Block {
        StreamEntry entries[kBlock];
    };
    using Spare = std::vector<std::unique_ptr<Block>>;

    [[nodiscard]] std::size_t size() const { return m_size; }
    [[nodiscard]] bool empty() const { return m_size == 0; }
    [[nodiscard]] const StreamEntry& operator[](std::size_t index) const {
        const std::size_t place = m_front + index;
        return m_blocks[place / kBlock]->entries[place % kBlock];
    }
    [[nodiscard]] const StreamEntry& back() const { return (*this)[m_size - 1]; }

    /// Place of the newest entry at or before a packet or a stamp; nothing where all are later.
    [[nodiscard]] std::optional<std::size_t> atOrBeforePacket(std::uint64_t packet) const;
    [[nodiscard]] std::optional<std::size_t> atOrBeforeStamp(Stamp stamp) const;

    /// `spare` lends blocks that are not in use, and gets them back.
    void append(StreamEntry entry, Spare& spare);
    void dropBefore(std::uint64_t packet, Spare& spare);

private:
    std::deque<std::unique_ptr<Block>> m_blocks;
    std::size_t m_front = 0; ///< place of the first entry in the first block
    std::size_t m_size = 0;
};

/// Finds the datagrams of each stream by time. Follows a log through a reader and forgets with it; belongs to
/// the thread of that reader. Memory is bounded by that of the log, whatever a sender does.
class StreamIndex {
public:
    /// A sender that makes up characters and types must not grow the index for ever: of further streams only
    /// the datagrams are counted.
    static constexpr std::size_t kStreamLimit = 4096;

    /// Takes in what is new in `reader` since the last call and drops what the log has dropped. The caller
    /// has called reader.refresh(). At most `packetLimit` packets are read, so that a long file need not be
    /// indexed in one go. True where nothing is left to be read.
    bool follow(LogReader& reader, std::uint64_t packetLimit = UINT64_MAX);

    /// Takes in one packet: for whoever walks over the packets anyway. Numbers must grow.
    void add(const Packet& packet);
    /// The same for one whose header was read already.
    void add(const Packet& packet, const wire::Header& header);
    /// Forgets entries of packets below `begin`, and streams of which nothing is left.
    void dropBefore(std::uint64_t begin);

    /// Streams in the order in which they appeared; changes with version().
    [[nodiscard]] std::span<const StreamKey> streams() const { return m_keys; }
    [[nodiscard]] std::uint64_t version() const { return m_version; }

    /// Null where there is no such stream. Valid until the next follow(), add() or dropBefore().
    [[nodiscard]] const StreamEntries* find(const StreamKey& key) const;

    /// One past the last packet that was taken in.
    [[nodiscard]] std::uint64_t end() const { return m_end; }
    /// Datagrams of streams beyond the limit.
    [[nodiscard]] std::uint64_t unindexed() const { return m_unindexed; }

private:
    StreamEntries* entriesFor(const StreamKey& key);

    std::unordered_map<StreamKey, std::unique_ptr<StreamEntries>> m_streams;
    std::vector<StreamKey> m_keys;
    StreamEntries::Spare m_spare;
    StreamKey m_lastKey;
    StreamEntries* m_lastEntries = nullptr;
    std::uint64_t m_begin = 0;
    std::uint64_t m_end = 0;
    std::uint64_t m_version = 0;
    std::uint64_t m_unindexed = 0;
};

} // namespace posewire::log
