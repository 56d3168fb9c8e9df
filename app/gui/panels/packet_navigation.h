// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/panels/packet_listing.h"

#include <QCoreApplication>

namespace posewire::gui {

enum class Direction { Backward, Forward };

/// Where the operator can go in the list of packets. What cannot be reached is said below the list.
class PacketNavigation {
    Q_DECLARE_TR_FUNCTIONS(PacketNavigation)

public:
    explicit PacketNavigation(PacketListing listing) : m_at(std::move(listing)) {}

    /// Selects a packet; says so where the filter does not show it.
    void show(std::uint64_t number);
    /// Goes where the text says, see packetTarget(); the answer is what is wrong with it, empty for nothing.
    QString goTo(const QString& text);
    void askForPacket();
    void goToFirst();
    /// To the newest packet, and on with the list from then on.
    void goToNewest();
    void goToProblem(Direction direction);
    void goToSameStream(Direction direction);
    void goToMark(Direction direction);

private:
    PacketListing m_at;
};

} // namespace posewire::gui
