// SPDX-License-Identifier: MIT
#include "core/log/log_follower.h"

#include <algorithm>

namespace posewire::log {

LogFollower::LogFollower(const PacketLog& log) : m_reader(log), m_next(m_reader.begin()) {}

LogFollower::LogFollower(const PacketLog& log, std::uint64_t from) : m_reader(log), m_next(from) {
    skipTo(m_reader.begin());
}

LogFollower LogFollower::fromOldest(const PacketLog& log, std::uint64_t from) {
    LogFollower follower(log);
    follower.m_next = std::max(from, follower.m_next);
    return follower;
}

LogFollower LogFollower::fromNow(const PacketLog& log) {
    LogFollower follower(log);
    follower.m_next = follower.m_reader.end();
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

void LogFollower::passOver(std::uint64_t count) {
    m_next += count;
    m_overtaken += count;
    m_overtakenSince += count;
}

} // namespace posewire::log
