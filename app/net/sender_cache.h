// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/sender_table.h"

#include <netinet/in.h>

#include <array>
#include <cstdint>
#include <cstring>

namespace posewire::net {

/// Maps the kernel's form of an address to the sender's id, without formatting text for recent senders. One
/// for each socket.
class SenderCache {
public:
    SenderCache(log::SenderTable& table, std::uint16_t localPort) : m_table(&table), m_localPort(localPort) {}

    /// `address` is IPv4 or IPv6; all other families count as one sender.
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
    std::array<Entry, 64> m_entries; ///< one slot for each hash; a newcomer replaces the old entry
};

} // namespace posewire::net
