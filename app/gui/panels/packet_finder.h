// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/packet_search.h"
#include "app/gui/panels/packet_navigation.h"

#include <QTimer>

#include <memory>

namespace posewire::gui {

class FindBar;

/// Looks for what the find bar says in the bytes of the listed packets, on a thread of its own, and goes
/// there.
class PacketFinder {
    Q_DECLARE_TR_FUNCTIONS(PacketFinder)

public:
    PacketFinder(PacketListing listing, PacketNavigation& navigation, FindBar& bar);

    void open();
    /// Opens the bar where there is nothing to look for yet.
    void find(Direction direction);

private:
    void takeResult();

    PacketListing m_at;
    PacketNavigation& m_navigation;
    FindBar& m_bar;
    std::unique_ptr<PacketSearch> m_search;
    QTimer m_poll;
};

} // namespace posewire::gui
