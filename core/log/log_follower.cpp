// SPDX-License-Identifier: MIT
#include "core/log/log_follower.h"

#include <algorithm>

namespace posewire::log {

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
