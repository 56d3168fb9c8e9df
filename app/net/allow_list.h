// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/endpoint.h"

#include <QHostAddress>

#include <string>
#include <vector>

namespace posewire::net {

/// Whom a receiver listens to: everyone, or the hosts and nets that were named. Asked once for each sender's
/// address, never for each datagram.
class AllowList {
public:
    /// Everyone.
    AllowList() = default;

    /// An entry is an IPv4 or IPv6 address, a net such as 10.0.0.0/8, or the name of a host, which is looked
    /// up now and may take seconds. Without entries: everyone. An address may name the interface it is heard
    /// on, "fe80::1%eth0", which must be there.
    [[nodiscard]] static NetResult<AllowList> of(const std::vector<std::string>& entries);

    /// The addresses and nets of `entries`, without looking up any name: until that is done nobody else is
    /// listened to. Leaves out what makes no sense.
    [[nodiscard]] static AllowList withoutNames(const std::vector<std::string>& entries);

    [[nodiscard]] bool isEveryone() const { return m_isEveryone; }
    /// IPv4 is recognised also if an IPv6 socket received it.
    [[nodiscard]] bool allows(const QHostAddress& address) const;

private:
    struct Net {
        QHostAddress address;
        int prefix; ///< bits
    };
    std::vector<Net> m_nets;
    bool m_isEveryone = true;
};

/// What is wrong with an entry as it is typed, in one line; empty if it may be an address, a net or a
/// name.
[[nodiscard]] std::string problemWithEntry(const std::string& entry);

} // namespace posewire::net
