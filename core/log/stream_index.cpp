// SPDX-License-Identifier: MIT
#include "core/log/stream_index.h"

#include <algorithm>

namespace posewire::log {

namespace {

/// Blocks kept for use again; more go back to the system.
constexpr std::size_t kSpareLimit = 64;

template <typename Value, typename Member>
std::optional<std::size_t> newestAtOrBefore(const StreamEntries& entries, Value limit, Member member) {
    std::size_t first = 0; // entries before it are not later than the limit
    for (std::size_t end = entries.size(); first < end;) {
        const std::size_t middle = first + (end - first) / 2;
        if (limit < entries[middle].*member) {
            end = middle;
        } else {
            first = middle + 1;
        }
    }
    return first == 0 ? std::nullopt : std::optional(first - 1);
}

} // namespace

std::optional<std::size_t> StreamEntries::atOrBeforePacket(std::uint64_t packet) const {
    return newestAtOrBefore(*this, packet, &StreamEntry::packet);
}

std::optional<std::size_t> StreamEntries::atOrBeforeStamp(Stamp stamp) const {
    return newestAtOrBefore(*this, stamp, &StreamEntry::stamp);
}

void StreamEntries::append(StreamEntry entry, Spare& spare) {
    if (m_size > 0) {
        entry.stamp = std::max(entry.stamp, back().stamp);
    }
    const std::size_t place = m_front + m_size;
    if (place == m_blocks.size() * kBlock) {
        if (spare.empty()) {
            m_blocks.push_back(std::make_unique<Block>());
        } else {
            m_blocks.push_back(std::move(spare.back()));
            spare.pop_back();
        }
    }
    m_blocks[place / kBlock]->entries[place % kBlock] = entry;
    ++m_size;
}

void StreamEntries::dropBefore(std::uint64_t packet, Spare& spare) {
    const std::size_t dropped = packet == 0 ? 0 : atOrBeforePacket(packet - 1).value_or(SIZE_MAX) + 1;
    m_front += dropped;
    m_size -= dropped;
    while (m_front >= kBlock || (m_size == 0 && !m_blocks.empty())) {
        if (spare.size() < kSpareLimit) {
            spare.push_back(std::move(m_blocks.front()));
        }
        m_blocks.pop_front();
        m_front -= std::min(m_front, kBlock);
    }
}

void StreamIndex::add(const Packet& packet, const wire::Header& header) {
    if (StreamEntries* entries = entriesFor({packet.sender, header.character, header.type()})) {
        entries->append(
            {packet.number, packet.stamp, header.sampleCounter, header.datagramIndex(), header.isLast()},
            m_spare);
    }
}

void StreamIndex::dropBefore(std::uint64_t begin) {
    if (begin <= m_begin) {
        return;
    }
    m_begin = begin;
    const std::size_t gone = std::erase_if(m_streams, [&](auto& stream) {
        stream.second->dropBefore(begin, m_spare);
        return stream.second->empty();
    });
    if (gone != 0) {
        m_lastEntries = nullptr;
    }
}

const StreamEntries* StreamIndex::find(const StreamKey& key) const {
    const auto found = m_streams.find(key);
    return found == m_streams.end() ? nullptr : found->second.get();
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
        found = m_streams.emplace(key, std::make_unique<StreamEntries>()).first;
    }
    m_lastKey = key;
    m_lastEntries = found->second.get();
    return m_lastEntries;
}

} // namespace posewire::log
