// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/sender_cache.h"

#include "app/net/endpoint.h"

#include <arpa/inet.h>
#include <net/if.h>

#include <cstring>
#include <string>

namespace posewire::net {

namespace {

/// "127.0.0.1:40001"; IPv4 in its own form even where an IPv6 socket received it.
std::string senderText(const sockaddr_in6& address) {
    std::array<char, INET6_ADDRSTRLEN> text{};
    if (address.sin6_family == AF_INET) {
        sockaddr_in ipv4{};
        std::memcpy(&ipv4, &address, sizeof ipv4);
        ::inet_ntop(AF_INET, &ipv4.sin_addr, text.data(), text.size());
        return textOf({text.data(), ntohs(ipv4.sin_port)});
    }
    if (address.sin6_family != AF_INET6) {
        return "unknown sender";
    }
    if (IN6_IS_ADDR_V4MAPPED(&address.sin6_addr)) {
        ::inet_ntop(AF_INET, &address.sin6_addr.s6_addr[12], text.data(), text.size());
        return textOf({text.data(), ntohs(address.sin6_port)});
    }
    ::inet_ntop(AF_INET6, &address.sin6_addr, text.data(), text.size());
    std::string host = text.data();
    std::array<char, IF_NAMESIZE> interface {};
    if (address.sin6_scope_id != 0 && ::if_indextoname(address.sin6_scope_id, interface.data()) != nullptr) {
        host += std::string("%") + interface.data();
    }
    return textOf({host, ntohs(address.sin6_port)});
}

std::size_t hashOf(const sockaddr_in6& address) {
    // The port and the last four bytes of either kind of address distinguish senders well enough.
    std::uint32_t ipv4 = 0;
    std::uint32_t ipv6 = 0;
    std::memcpy(&ipv4, reinterpret_cast<const char*>(&address) + offsetof(sockaddr_in, sin_addr),
                sizeof ipv4);
    std::memcpy(&ipv6, &address.sin6_addr.s6_addr[12], sizeof ipv6);
    return (ipv4 ^ ipv6 * 31U ^ address.sin6_port * 0x9e37U) * 0x9e3779b9U >> 26;
}

} // namespace

log::SenderId SenderCache::look(const sockaddr_in6& address) {
    Entry& entry = m_entries[hashOf(address)];
    if (std::memcmp(&entry.address, &address, sizeof address) != 0) {
        entry = {address, m_table->intern({senderText(address), log::Transport::Udp, m_localPort})};
    }
    m_last = entry;
    return entry.id;
}

} // namespace posewire::net
