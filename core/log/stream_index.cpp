// SPDX-License-Identifier: MIT
#include "core/log/stream_index.h"

#include <algorithm>

namespace posewire::log {
namespace {

/// Place of the last entry whose member is not above `limit`.
template <typename Value, typename Member>
std::optional<std::size_t> newestAtOrBefore(const std::deque<StreamEntry>& entries, Value limit,
                                            Member member) {
    const auto later = std::ranges::upper_bound(entries, limit, {}, member);
    return later == entries.begin() ? std::nullopt : std::optional<std::size_t>(later - entries.begin() - 1);
}

} // namespace

std::optional<std::size_t> StreamEntries::atOrBeforePacket(std::uint64_t packet) const {
    return newestAtOrBefore(m_entries, packet, &StreamEntry::packet);
}

std::optional<std::size_t> StreamEntries::atOrBeforeStamp(Stamp stamp) const {
    return newestAtOrBefore(m_entries, stamp, &StreamEntry::stamp);
}

void StreamEntries::append(StreamEntry entry) {
    if (!m_entries.empty()) {
        entry.stamp = std::max(entry.stamp, m_entries.back().stamp);
    }
    m_entries.push_back(entry);
}

void StreamEntries::dropBefore(std::uint64_t packet) {
    m_entries.erase(m_entries.begin(), std::ranges::lower_bound(m_entries, packet, {}, &StreamEntry::packet));
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
    constexpr std::size_t kOfStream = 640; // with the first block of its entries
    std::size_t entries = 0;
    for (const auto& [key, stream] : m_streams) {
        entries += stream.size();
    }
    return m_streams.size() * kOfStream + entries * sizeof(StreamEntry);
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
        found = m_streams.try_emplace(key).first;
    }
    m_lastKey = key;
    m_lastEntries = &found->second;
    return m_lastEntries;
}

} // namespace posewire::log
