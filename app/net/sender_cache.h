// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/sender_table.h"

#include <netinet/in.h>

#include <array>
#include <cstdint>
#include <cstring>

namespace posewire::net {

/// From the kernel's form of an address to the sender's id, without making text for senders seen lately. For
/// one socket.
class SenderCache {
public:
    SenderCache(log::SenderTable& table, std::uint16_t localPort) : m_table(&table), m_localPort(localPort) {}

    /// `address` is IPv4 or IPv6; of anything else all senders are one.
    log::SenderId idOf(const sockaddr_in6& address) {
        return std::memcmp(&m_last.address, &address, sizeof address) == 0 ? m_last.id : look(address);
    }

private:
    struct Entry {
        sockaddr_in6 address{};
        log::SenderId id{};
    };

    log::SenderId look(const sockaddr_in6& address);

    log::SenderTable* m_table;
    std::uint16_t m_localPort;
    Entry m_last;
    std::array<Entry, 64> m_entries; ///< a place for each hash; the newcomer takes it over
};

} // namespace posewire::net
