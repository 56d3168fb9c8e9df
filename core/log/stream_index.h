// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/log/scratch.h"
#include "core/log/time.h"
#include "core/wire/header.h"

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <unordered_map>

namespace posewire::log {

/// A stream is what one sender sends of one character in one message type. In order of these.
struct StreamKey {
    SenderId sender{};
    std::uint8_t character = 0;
    std::uint8_t type = 0; ///< the two digits as a decimal number

    friend auto operator<=>(const StreamKey&, const StreamKey&) = default;
};

} // namespace posewire::log

/// Senders are numbered densely from 0: multiplying spreads the bits over all buckets.
template <>
struct std::hash<posewire::log::StreamKey> {
    std::size_t operator()(const posewire::log::StreamKey& key) const noexcept {
        const auto sender = static_cast<std::uint64_t>(key.sender);
        return static_cast<std::size_t>(
            (sender << 16 | std::uint64_t{key.character} << 8 | key.type) * 0x9e3779b97f4a7c15U >> 13);
    }
};

namespace posewire::log {

/// One datagram of a stream.
struct StreamEntry {
    std::uint64_t packet = 0; ///< its number in the log
    Stamp stamp{}; ///< the packet's, but never before that of the entry before: clocks may be set back
    std::uint32_t sample = 0;  ///< sample counter
    std::uint8_t datagram = 0; ///< index of the datagram within its sample
    bool isLast = false;       ///< the last one of its sample
};

/// The entries of one stream, oldest first.
class StreamEntries {
public:
    explicit StreamEntries(std::shared_ptr<Scratch> scratch = std::make_shared<Scratch>())
        : m_scratch(std::move(scratch)) {}

    [[nodiscard]] std::size_t size() const { return m_end - m_begin; }
    [[nodiscard]] bool empty() const { return size() == 0; }
    [[nodiscard]] const StreamEntry& operator[](std::size_t index) const {
        const std::size_t place = m_begin + index;
        return (*m_blocks[place / kBlock])[place % kBlock];
    }
    [[nodiscard]] const StreamEntry& back() const { return (*this)[size() - 1]; }

    /// Place of the newest entry at or before a packet or a stamp; empty if all are later.
    [[nodiscard]] std::optional<std::size_t> atOrBeforePacket(std::uint64_t packet) const;
    [[nodiscard]] std::optional<std::size_t> atOrBeforeStamp(Stamp stamp) const;

    void append(StreamEntry entry);
    void dropBefore(std::uint64_t packet);

    [[nodiscard]] std::size_t memoryBytes() const { return m_blocks.size() * (sizeof(Block) + kBesideBlock); }

private:
    static constexpr std::size_t kBlock = 21;       // small: most streams of a flood have few
    static constexpr std::size_t kBesideBlock = 64; // who owns it, at most
    using Block = std::array<StreamEntry, kBlock>;
    /// Blocks that were made together, of which some are not in use yet.
    struct Spare {
        std::shared_ptr<std::byte[]> owner;
        Block* next = nullptr;
        std::size_t count = 0;
    };

    void addBlock();

    std::shared_ptr<Scratch> m_scratch;
    std::deque<std::shared_ptr<Block>> m_blocks;
    Spare m_spare;
    std::size_t m_begin = 0; ///< of the first block, before this all are forgotten
    std::size_t m_end = 0;   ///< counted from the beginning of the first block
};

/// Finds the datagrams of each stream by time. Belongs to one thread, which takes in what the log gets and
/// forgets what it drops. Memory is bounded by that of the log, whatever a sender does.
class StreamIndex {
public:
    /// A sender that makes up characters and types must not grow the index for ever: further streams are left
    /// out.
    static constexpr std::size_t kStreamLimit = 4096;

    explicit StreamIndex(std::shared_ptr<Scratch> scratch = std::make_shared<Scratch>())
        : m_scratch(std::move(scratch)) {}

    /// Takes in one datagram of the log. Numbers must grow.
    void add(const Packet& packet, const wire::Header& header);
    /// Forgets a stream.
    void forget(const StreamKey& key);
    /// Forgets entries of packets below `begin`, and streams of which nothing is left.
    void dropBefore(std::uint64_t begin);

    [[nodiscard]] std::size_t memoryBytes() const;

    /// Null if there is no such stream. Valid until the next add() or dropBefore().
    [[nodiscard]] const StreamEntries* find(const StreamKey& key) const;

private:
    StreamEntries* entriesFor(const StreamKey& key);

    std::shared_ptr<Scratch> m_scratch;
    std::unordered_map<StreamKey, StreamEntries> m_streams;
    StreamKey m_lastKey;
    StreamEntries* m_lastEntries = nullptr;
    std::uint64_t m_begin = 0;
};

} // namespace posewire::log
