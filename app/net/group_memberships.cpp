// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/group_memberships.h"

#include "app/net/endpoint.h"

#include <algorithm>

namespace posewire::net {
namespace {

QList<QHostAddress> addressesOf(const QNetworkInterface& interface,
                                QAbstractSocket::NetworkLayerProtocol protocol) {
    QList<QHostAddress> addresses;
    for (const QNetworkAddressEntry& entry : interface.addressEntries()) {
        if (entry.ip().protocol() == protocol) {
            addresses.push_back(entry.ip());
        }
    }
    return addresses;
}

bool canJoin(const QNetworkInterface& interface) {
    const auto flags = interface.flags();
    return flags.testFlag(QNetworkInterface::IsUp) &&
           (flags.testFlag(QNetworkInterface::CanMulticast) || flags.testFlag(QNetworkInterface::IsLoopBack));
}

std::string nameOf(const QNetworkInterface& interface) {
    return interface.humanReadableName().toStdString();
}

void append(std::string& text, const std::string& more, const char* separator) {
    text += (text.empty() ? "" : separator) + more;
}

} // namespace

void GroupMemberships::follow(const QList<QNetworkInterface>& interfaces) {
    for (Group& group : m_groups) {
        follow(group, interfaces);
    }
    m_hasOwn = std::ranges::any_of(interfaces, [this](const QNetworkInterface& interface) {
        return interface.flags().testFlag(QNetworkInterface::IsUp) &&
               addressesOf(interface, m_own.protocol()).contains(m_own);
    });
    m_hadOwn = m_hadOwn || m_hasOwn;
}

void GroupMemberships::follow(Group& group, const QList<QNetworkInterface>& interfaces) {
    std::vector<Place> places;
    const bool isOnOne = !group.address.scopeId().isEmpty();
    const int zone = zoneOf(group.address).index();
    for (const QNetworkInterface& interface : interfaces) {
        if (isOnOne && interface.index() != zone) {
            continue;
        }
        Place place{interface, addressesOf(interface, group.address.protocol()), {}};
        if (canJoin(interface) && !place.addresses.isEmpty()) {
            places.push_back(std::move(place));
        }
    }
    const auto isSame = [](const Place& a, const Place& b) {
        return a.interface.index() == b.interface.index() && a.addresses == b.addresses;
    };
    // First leave: a system allows a socket few memberships, and one of an interface that is gone counts too.
    for (const Place& old : group.places) {
        const bool stays =
            std::ranges::any_of(places, [&](const Place& place) { return isSame(old, place); });
        if (!stays && old.failure.empty()) {
            group.change(group.address, old.interface, false);
        }
    }
    for (Place& place : places) {
        const bool isJoined = std::ranges::any_of(
            group.places, [&](const Place& old) { return old.failure.empty() && isSame(old, place); });
        place.failure = isJoined ? std::string() : group.change(group.address, place.interface, true);
    }
    group.places = std::move(places);
}

std::string GroupMemberships::text() const {
    std::string text = "listening";
    for (const Group& group : m_groups) {
        std::string names;
        std::size_t count = 0;
        for (const Place& place : group.places) {
            if (place.failure.empty()) {
                append(names, nameOf(place.interface), ", ");
                ++count;
            }
        }
        text += "; " + group.address.toString().toStdString() + " joined on " +
                (count == 0
                     ? "no interface"
                     : std::to_string(count) + (count == 1 ? " interface (" : " interfaces (") + names + ")");
    }
    return text;
}

std::string GroupMemberships::problem() const {
    std::string text;
    if (m_hadOwn && !m_hasOwn) {
        text = "no interface that is up has the address " + m_own.toString().toStdString() +
               " any more, so nothing arrives; connect its network, or listen on another address";
    }
    for (const Group& group : m_groups) {
        const std::string address = group.address.toString().toStdString();
        if (std::string zone = problemWithZone(group.address); !zone.empty()) {
            append(text, zone + ", or connect that one, and the group is joined at once", "; ");
        } else if (group.places.empty()) {
            append(text,
                   address + " is joined on no interface; connect the network, and it is joined at once",
                   "; ");
        }
        for (const Place& place : group.places) {
            if (!place.failure.empty()) {
                append(text,
                       address + " could not be joined on " + nameOf(place.interface) + ": " + place.failure,
                       "; ");
            }
        }
    }
    return text;
}

} // namespace posewire::net
