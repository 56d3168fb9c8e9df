// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QHostAddress>
#include <QList>
#include <QNetworkInterface>

#include <functional>
#include <string>
#include <vector>

namespace posewire::net {

/// What one input wants of the interfaces. Its multicast groups: a sender may be reached by any interface, so
/// a group is joined on all that are up, or on the one that it names ("ff02::1%eth0"), also on those that
/// appear later. And its own address, where it
/// listens on one alone. Belongs to the receiving thread.
class GroupMemberships {
public:
    /// Joins a group on an interface or leaves it there; empty, or what the system says against it.
    using Change =
        std::function<std::string(const QHostAddress& group, const QNetworkInterface& interface, bool joins)>;

    /// A group is joined by follow(). `change` is called there and must stay callable.
    void add(const QHostAddress& group, Change change) { m_groups.push_back({group, std::move(change), {}}); }
    /// The input hears what is sent to this address alone.
    void listensOn(const QHostAddress& address) { m_own = address; }
    [[nodiscard]] bool isEmpty() const { return m_groups.empty() && m_own.isNull(); }

    /// Joins if it is not joined yet, leaves where an interface is down or gone, and joins again where an
    /// address has changed.
    void follow(const QList<QNetworkInterface>& interfaces);

    /// "listening; 239.1.1.1 joined on 2 interfaces (eth0, lo)".
    [[nodiscard]] std::string text() const;
    /// Where a group could not be joined, and why, and that the own address has gone; empty if there is no
    /// problem.
    [[nodiscard]] std::string problem() const;

private:
    struct Place {
        QNetworkInterface interface;
        QList<QHostAddress> addresses; ///< of the group's protocol, at the time of joining
        std::string failure;           ///< empty: joined
    };
    struct Group {
        QHostAddress address;
        Change change;
        std::vector<Place> places;
    };
    static void follow(Group& group, const QList<QNetworkInterface>& interfaces);

    std::vector<Group> m_groups;
    QHostAddress m_own;
    bool m_hadOwn = false; ///< an interface has had it
    bool m_hasOwn = false;
};

} // namespace posewire::net
