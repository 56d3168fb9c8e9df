// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/packet_finder.h"

#include "app/gui/models/text.h"
#include "app/gui/panels/find_bar.h"

namespace posewire::gui {

namespace {

constexpr int kPollMs = 20;

} // namespace

PacketFinder::PacketFinder(PacketListing listing, PacketNavigation& navigation, FindBar& bar)
    : m_at(std::move(listing)), m_navigation(navigation), m_bar(bar) {
    m_poll.setInterval(kPollMs);
    m_poll.callOnTimeout([this] { takeResult(); });
}

void PacketFinder::open() {
    m_bar.open();
}

void PacketFinder::find(Direction direction) {
    if (m_bar.text().isEmpty()) {
        m_bar.open();
        return;
    }
    auto pattern = parsePattern(m_bar.text(), m_bar.isHexadecimal());
    if (!pattern) {
        m_bar.open();
        m_bar.say(pattern.error(), true);
        return;
    }
    PacketSearch::Request request{
        *std::move(pattern), m_at.selected().value_or(m_at.view.end()), direction == Direction::Forward, {}};
    if (m_at.packets.isFiltered()) {
        request.among = m_at.packets.matches();
        if (request.among.empty()) {
            m_bar.say(tr("No packet is listed"), true);
            return;
        }
    }
    m_search = std::make_unique<PacketSearch>(m_at.view.log(), std::move(request));
    m_bar.say(tr("Searching …"), false);
    m_poll.start();
}

void PacketFinder::takeResult() {
    const auto result = m_search ? m_search->result() : std::nullopt;
    if (!result) {
        return;
    }
    m_poll.stop();
    m_search.reset();
    if (!result->packet) {
        m_bar.say(tr("Not found"), true);
        return;
    }
    m_navigation.show(*result->packet);
    const QString place = tr("in packet %1, byte %2").arg(grouped(*result->packet)).arg(result->offset);
    m_bar.say(result->isWrapped ? tr("%1 (wrapped around)").arg(place) : place, false);
}

} // namespace posewire::gui
