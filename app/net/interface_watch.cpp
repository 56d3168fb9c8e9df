// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/interface_watch.h"

#include <linux/netlink.h>
#include <linux/rtnetlink.h>

#include <array>
#include <cerrno>

namespace posewire::net {
namespace {

/// -1 where it is refused.
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

InterfaceWatch::InterfaceWatch() : m_socket(subscribe()) {}

bool InterfaceWatch::hasChanged() {
    // What has changed is asked for afterwards; that something has is all there is to know here.
    std::array<std::byte, 8192> message;
    bool hasChanged = false;
    while (true) {
        const auto size = ::recv(m_socket.get(), message.data(), message.size(), MSG_DONTWAIT);
        if (size < 0 && errno == ENOBUFS) {
            hasChanged = true; // more than the kernel could keep for us
        } else if (size <= 0) {
            return hasChanged;
        }
        hasChanged = true;
    }
}

} // namespace posewire::net
