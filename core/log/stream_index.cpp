// SPDX-License-Identifier: MIT
#include "core/log/stream_index.h"

#include <algorithm>
#include <bit>

namespace posewire::log {
namespace {

/// How many entries have a member that is not above `limit`.
template <typename Value, typename Member>
std::size_t countAtOrBefore(const StreamEntries& entries, Value limit, Member member) {
    std::size_t low = 0;
    std::size_t high = entries.size();
    while (low < high) {
        const std::size_t middle = low + (high - low) / 2;
        if (limit < entries[middle].*member) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

std::optional<std::size_t> lastOf(std::size_t count) {
    return count == 0 ? std::nullopt : std::optional(count - 1);
}

} // namespace

std::optional<std::size_t> StreamEntries::atOrBeforePacket(std::uint64_t packet) const {
    return lastOf(countAtOrBefore(*this, packet, &StreamEntry::packet));
}

std::optional<std::size_t> StreamEntries::atOrBeforeStamp(Stamp stamp) const {
    return lastOf(countAtOrBefore(*this, stamp, &StreamEntry::stamp));
}

void StreamEntries::append(StreamEntry entry) {
    if (!empty()) {
        entry.stamp = std::max(entry.stamp, back().stamp);
    }
    if (m_end == m_blocks.size() * kBlock) {
        addBlock();
    }
    (*m_blocks.back())[m_end % kBlock] = entry;
    ++m_end;
}

/// The more there are, the more are made at once: who owns them takes as much as an eighth of a small one.
void StreamEntries::addBlock() {
    constexpr std::size_t kMostAtOnce = 64;
    if (m_spare.count == 0) {
        const std::size_t count = std::bit_floor(
            std::clamp<std::size_t>(m_blocks.size() / 8, 1, kMostAtOnce)); // few sizes, to be used again
        m_spare.owner = m_scratch->bytes(count * sizeof(Block));
        m_spare.next = reinterpret_cast<Block*>(m_spare.owner.get());
        m_spare.count = count;
        std::uninitialized_default_construct_n(m_spare.next, count);
    }
    m_blocks.emplace_back(m_spare.owner, m_spare.next++);
    if (--m_spare.count == 0) {
        m_spare.owner.reset();
    }
}

void StreamEntries::dropBefore(std::uint64_t packet) {
    if (packet == 0 || empty()) {
        return;
    }
    m_begin += countAtOrBefore(*this, packet - 1, &StreamEntry::packet);
    while (m_begin >= kBlock) {
        m_blocks.pop_front();
        m_begin -= kBlock;
        m_end -= kBlock;
    }
}

void StreamIndex::add(const Packet& packet, const wire::Header& header) {
    if (StreamEntries* entries = entriesFor({packet.sender, header.character, header.type()})) {
        entries->append(
            {packet.number, packet.stamp, header.sampleCounter, header.datagramIndex(), header.isLast()});
    }
}

void StreamIndex::forget(const StreamKey& key) {
    m_streams.erase(key);
    m_lastEntries = nullptr;
}

void StreamIndex::dropBefore(std::uint64_t begin) {
    if (begin <= m_begin) {
        return;
    }
    m_begin = begin;
    for (auto stream = m_streams.begin(); stream != m_streams.end();) {
        stream->second.dropBefore(begin);
        if (stream->second.empty()) {
            stream = m_streams.erase(stream);
            m_lastEntries = nullptr;
        } else {
            ++stream;
        }
    }
}

std::size_t StreamIndex::memoryBytes() const {
    constexpr std::size_t kOfStream = 128;
    std::size_t entries = 0;
    for (const auto& [key, stream] : m_streams) {
        entries += stream.memoryBytes();
    }
    return m_streams.size() * kOfStream + entries;
}

const StreamEntries* StreamIndex::find(const StreamKey& key) const {
    const auto found = m_streams.find(key);
    return found == m_streams.end() ? nullptr : &found->second;
}

StreamEntries* StreamIndex::entriesFor(const StreamKey& key) {
    if (m_lastEntries != nullptr && key == m_lastKey) {
        return m_lastEntries;
    }
    auto found = m_streams.find(key);
    if (found == m_streams.end()) {
        if (m_streams.size() == kStreamLimit) {
            return nullptr;
        }
        found = m_streams.try_emplace(key, m_scratch).first;
    }
    m_lastKey = key;
    m_lastEntries = &found->second;
    return m_lastEntries;
}

} // namespace posewire::log
