// SPDX-License-Identifier: MIT
#include "core/log/log_reader.h"

#include "core/log/packet_log.h"

#include <algorithm>

namespace posewire::log {

LogReader::LogReader(const PacketLog& log)
    : m_history(&log.history()), m_past(&log.past()), m_pastReader(log.past()) {
    refresh();
}

bool LogReader::refresh() {
    m_held.clear();
    m_current = nullptr;
    m_currentCount = 0;
    const std::uint64_t before = m_end;
    m_end = m_history->end(); // first: the list read after it then contains every packet below
    if (const std::uint64_t version = m_history->version(); version != m_version) {
        m_version = version;
        m_entries = m_history->entries();
    }
    // The list may be younger than the end: all that was to be seen can have been dropped in between.
    m_begin = m_entries.empty() ? 0 : std::min({m_entries.front().first, m_past->begin(), m_end});
    return m_end != before;
}

std::optional<Packet> LogReader::packetElsewhere(std::uint64_t number) {
    if (number < m_begin || number >= m_end) {
        return std::nullopt;
    }
    return enterChunk(number) ? view(number) : m_pastReader.packet(number);
}

std::optional<Packet> LogReader::packetFrom(std::uint64_t number) {
    const std::uint64_t inMemory = m_entries.empty() ? m_end : m_entries.front().first;
    std::optional<Packet> found;
    for (number = std::max(number, m_begin); number < m_end && !(found = packet(number));) {
        ++number;
        number = std::min(m_past->nextFrom(number), std::max(number, inMemory));
    }
    return found;
}

std::optional<DropSums> LogReader::dropsBefore(std::uint64_t number) {
    if (number == 0) {
        return DropSums();
    }
    if (number > m_end || !enterChunk(number)) {
        return dropsBeforeInPast(number);
    }
    DropSums drops = m_currentDrops;
    for (std::uint64_t below = m_currentFirst; below < number; ++below) {
        const Packet packet = view(below);
        drops.add(packet.kernelDropsBefore, packet.flags);
    }
    return drops;
}

std::optional<DropSums> LogReader::dropsBeforeInPast(std::uint64_t number) const {
    const auto part = m_past->find(number);
    std::optional<DropSums> drops = part ? part->drops : std::nullopt;
    for (std::uint64_t before = 0; drops && before < number - part->first; ++before) {
        const Arrival& arrival = part->places[before].arrival;
        drops->add(arrival.kernelDropsBefore, arrival.flags);
    }
    return drops;
}

bool LogReader::enterChunk(std::uint64_t number) {
    const auto next = std::ranges::upper_bound(m_entries, number, {}, &ChunkHistory::Entry::first);
    if (next == m_entries.begin()) {
        return false;
    }
    const auto entry = next - 1;
    std::shared_ptr<const Chunk>& held = m_held[entry->first];
    held = held ? held : entry->chunk.lock();
    if (!held) {
        return false;
    }
    m_current = held.get();
    m_currentFirst = entry->first;
    m_currentDrops = entry->drops;
    m_currentCount = (next == m_entries.end() ? m_end : std::min(next->first, m_end)) - m_currentFirst;
    return true;
}

LogFollower::LogFollower(const PacketLog& log) : m_reader(log), m_next(0) {
    beginAt(m_reader.begin());
}

LogFollower::LogFollower(const PacketLog& log, std::uint64_t from) : m_reader(log), m_next(0) {
    beginAt(from);
    skipTo(m_reader.begin());
}

LogFollower LogFollower::fromOldest(const PacketLog& log, std::uint64_t from) {
    LogFollower follower(log);
    follower.beginAt(std::max(from, follower.m_next));
    return follower;
}

LogFollower LogFollower::fromNow(const PacketLog& log) {
    LogFollower follower(log);
    follower.beginAt(follower.m_reader.end());
    return follower;
}

void LogFollower::refresh() {
    m_reader.refresh();
    skipTo(m_reader.begin());
}

std::optional<Packet> LogFollower::next(std::uint64_t end) {
    while (m_next < std::min(end, m_reader.end())) {
        if (auto packet = m_reader.packet(m_next)) {
            ++m_next;
            countDrops(*packet);
            return packet;
        }
        passOver(1); // dropped since the last refresh()
    }
    return std::nullopt;
}

void LogFollower::skipTo(std::uint64_t number) {
    if (number > m_next) {
        passOver(number - m_next);
    }
}

void LogFollower::beginAt(std::uint64_t number) {
    m_next = number;
    m_drops = m_reader.dropsBefore(number);
}

void LogFollower::passOver(std::uint64_t count) {
    m_next += count;
    m_overtaken += count;
    m_overtakenSince += count;
    m_mayHaveDrops = true;
}

/// Known in all where packets were passed over, else from packet to packet.
void LogFollower::countDrops(const Packet& packet) {
    if (std::exchange(m_mayHaveDrops, false) || !m_drops) {
        const auto now = m_reader.dropsBefore(packet.number);
        if (now && m_drops) {
            m_unseen.datagrams += now->datagrams - std::min(now->datagrams, m_drops->datagrams);
            m_unseen.records += now->records - std::min(now->records, m_drops->records);
        }
        m_drops = now ? now : m_drops;
    }
    m_dropsBeforeTaken = m_drops;
    if (m_drops) {
        m_drops->add(packet.kernelDropsBefore, packet.flags);
    }
}

} // namespace posewire::log
