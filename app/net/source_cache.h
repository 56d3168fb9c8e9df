// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/source_table.h"

#include <netinet/in.h>

#include <array>
#include <cstdint>

namespace posewire::net {

/// From the kernel's form of an address to the source's id, without making text for senders seen lately. For
/// one socket.
class SourceCache {
public:
    SourceCache(log::SourceTable& table, std::uint16_t localPort) : m_table(&table), m_localPort(localPort) {}

    /// `address` is IPv4 or IPv6; of anything else all senders are one.
    log::SourceId idOf(const sockaddr_in6& address);

private:
    struct Entry {
        sockaddr_in6 address{};
        log::SourceId id{};
    };

    log::SourceTable* m_table;
    std::uint16_t m_localPort;
    std::array<Entry, 64> m_entries; ///< a place for each hash; the newcomer takes it over
};

} // namespace posewire::net
