// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/kernel_socket.h"

#include "app/net/endpoint.h"

#include <arpa/inet.h>
#include <linux/netlink.h>
#include <linux/rtnetlink.h>
#include <linux/sock_diag.h>
#include <net/if.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <system_error>

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

/// With the interface it came by, which Qt leaves out.
QHostAddress addressOf(const sockaddr_in6& sender) {
    QHostAddress address(reinterpret_cast<const sockaddr*>(&sender));
    if (sender.sin6_family == AF_INET6 && sender.sin6_scope_id != 0) {
        address.setScopeId(QString::number(sender.sin6_scope_id));
    }
    return address;
}

/// -1 if it is refused.
int subscribe() {
    const int descriptor = ::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, NETLINK_ROUTE);
    sockaddr_nl address{};
    address.nl_family = AF_NETLINK;
    address.nl_groups = RTMGRP_LINK | RTMGRP_IPV4_IFADDR | RTMGRP_IPV6_IFADDR;
    if (descriptor >= 0 &&
        ::bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
        ::close(descriptor);
        return -1;
    }
    return descriptor;
}

} // namespace

void prepare(int descriptor) {
    const int on = 1;
    for (const int option : {SO_TIMESTAMPNS, SO_RXQ_OVFL}) {
        ::setsockopt(descriptor, SOL_SOCKET, option, &on, sizeof on);
    }
    // Qt asks the kernel for the interface and hop count of each datagram. Nobody here reads them, and they
    // cost a fifteenth of the receiving time.
    const int off = 0;
    for (const int option : {IP_PKTINFO, IP_RECVTTL}) {
        ::setsockopt(descriptor, IPPROTO_IP, option, &off, sizeof off);
    }
    for (const int option : {IPV6_RECVPKTINFO, IPV6_RECVHOPLIMIT}) {
        ::setsockopt(descriptor, IPPROTO_IPV6, option, &off, sizeof off);
    }
}

std::string changeMembership(int descriptor, const QHostAddress& group, int interface, bool joins) {
    const bool isIpv4 = group.protocol() == QAbstractSocket::IPv4Protocol;
    group_req request{};
    request.gr_interface = static_cast<std::uint32_t>(interface);
    if (isIpv4) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(group.toIPv4Address());
        std::memcpy(&request.gr_group, &address, sizeof address);
    } else {
        sockaddr_in6 address{};
        const Q_IPV6ADDR bytes = group.toIPv6Address();
        address.sin6_family = AF_INET6;
        std::memcpy(&address.sin6_addr, &bytes, sizeof bytes);
        std::memcpy(&request.gr_group, &address, sizeof address);
    }
    const int done = ::setsockopt(descriptor, isIpv4 ? IPPROTO_IP : IPPROTO_IPV6,
                                  joins ? MCAST_JOIN_GROUP : MCAST_LEAVE_GROUP, &request, sizeof request);
    return done == 0 ? std::string() : std::generic_category().message(errno);
}

std::optional<SocketMemory> memoryOf(int descriptor) {
    std::array<std::uint32_t, SK_MEMINFO_VARS> info{};
    socklen_t size = sizeof info;
    if (::getsockopt(descriptor, SOL_SOCKET, SO_MEMINFO, info.data(), &size) != 0) {
        return std::nullopt;
    }
    return SocketMemory{info[SK_MEMINFO_DROPS], info[SK_MEMINFO_RMEM_ALLOC], info[SK_MEMINFO_RCVBUF]};
}

MessageBatch::MessageBatch() {
    for (std::size_t i = 0; i < m_messages.size(); ++i) {
        msghdr& header = m_messages[i].msg_hdr;
        header.msg_name = &m_senders[i];
        header.msg_iov = m_parts[i].data();
        header.msg_iovlen = m_parts[i].size();
        header.msg_control = m_controls[i].bytes.data();
    }
}

std::size_t MessageBatch::receive(int descriptor, std::span<const log::LogWriter::Lane> lanes) {
    for (std::size_t i = 0; i < lanes.size(); ++i) {
        m_parts[i][0] = {lanes[i].bytes.data(), lanes[i].bytes.size()};
        m_parts[i][1] = {lanes[i].spill.data(), lanes[i].spill.size()};
        msghdr& header = m_messages[i].msg_hdr;
        header.msg_namelen = sizeof(sockaddr_in6);
        header.msg_controllen = kControlSize;
    }
    const int count =
        ::recvmmsg(descriptor, m_messages.data(), static_cast<unsigned>(lanes.size()), MSG_DONTWAIT, nullptr);
    return count < 0 ? 0 : static_cast<std::size_t>(count);
}

Received MessageBatch::received(std::size_t index) const {
    const msghdr& header = m_messages[index].msg_hdr;
    Received received;
    received.size = m_messages[index].msg_len;
    received.isTruncated = (header.msg_flags & MSG_TRUNC) != 0;
    // By hand, since CMSG_NXTHDR is a call into the library for each message, and there are very many here.
    const std::byte* const controls = m_controls[index].bytes.data();
    for (std::size_t at = 0; at + sizeof(cmsghdr) <= header.msg_controllen;) {
        cmsghdr control{};
        std::memcpy(&control, controls + at, sizeof control);
        const std::byte* const data = controls + at + CMSG_LEN(0);
        if (control.cmsg_level == SOL_SOCKET && control.cmsg_type == SO_TIMESTAMPNS) {
            timespec stamp{};
            std::memcpy(&stamp, data, sizeof stamp);
            received.time =
                log::WallTime(std::chrono::seconds(stamp.tv_sec) + std::chrono::nanoseconds(stamp.tv_nsec));
        } else if (control.cmsg_level == SOL_SOCKET && control.cmsg_type == SO_RXQ_OVFL) {
            std::memcpy(&received.drops, data, sizeof received.drops);
        }
        at += std::max(CMSG_ALIGN(control.cmsg_len), sizeof(cmsghdr));
    }
    return received;
}

SenderCache::Id SenderCache::look(const sockaddr_in6& address) {
    Entry& entry = m_entries[hashOf(address)];
    if (std::memcmp(&entry.address, &address, sizeof address) != 0) {
        const bool isHeard = m_allowed->isEveryone() || m_allowed->allows(addressOf(address));
        entry = {address, std::nullopt};
        if (isHeard) { // one who is not gets no place in the table of senders
            entry.id = m_table->intern({senderText(address), log::Transport::Udp, m_localPort});
            entry.held = m_table->find(*entry.id);
        }
    }
    m_last = &entry;
    return entry.id;
}

InterfaceWatch::InterfaceWatch() : m_socket(subscribe()) {}

bool InterfaceWatch::hasChanged() {
    // What has changed is asked for afterwards; that something has is all there is to know here.
    std::array<std::byte, 8192> message;
    bool hasChanged = false;
    while (true) {
        const auto size = ::recv(m_socket.number(), message.data(), message.size(), MSG_DONTWAIT);
        if (size < 0 && errno == ENOBUFS) {
            hasChanged = true; // more than the kernel could keep for us
        } else if (size <= 0) {
            return hasChanged;
        }
        hasChanged = true;
    }
}

} // namespace posewire::net
