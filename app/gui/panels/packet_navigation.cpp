// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/packet_navigation.h"

#include "app/gui/models/packet_choice.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/text_prompt.h"

#include <algorithm>

namespace posewire::gui {

void PacketNavigation::show(std::uint64_t number) {
    m_at.commands.selectPacket(number);
    m_at.list.setFollowing(false);
    m_at.refresh();
    if (m_at.packets.rowOf(number) < 0) {
        m_at.say(tr("Packet %1 is selected, but the filter hides it.").arg(grouped(number)));
    }
}

QString PacketNavigation::goTo(const QString& text) {
    const auto target = packetTarget(m_at.view, text);
    if (!target) {
        return target.error();
    }
    show(*target);
    return {};
}

void PacketNavigation::askForPacket() {
    TextPrompt prompt(
        {tr("Go to packet"), tr("&Number, +n or -n, or a time"), tr("1204112, +100, 12.5 s, 10:42:17.508"),
         tr("Go")},
        [&](const QString& text) { return goTo(text); }, m_at.list.window());
    prompt.exec();
}

void PacketNavigation::goToFirst() {
    if (m_at.packets.rowCount() > 0) {
        show(m_at.packets.packetAt(0));
    }
}

void PacketNavigation::goToNewest() {
    model::Selection selection = m_at.view.selection();
    selection.packet.reset();
    m_at.commands.select(selection);
    m_at.list.setFollowing(true);
    m_at.refresh();
}

void PacketNavigation::goToProblem(Direction direction) {
    const bool isForward = direction == Direction::Forward;
    const auto from = m_at.selected();
    const std::uint64_t begin = m_at.view.digests().begin();
    const model::PacketDigest* first = m_at.view.digests().find(begin);
    const bool isAtBegin =
        isForward && !from && first != nullptr && first->isProblem() && m_at.packets.rowOf(begin) >= 0;
    const auto found = isAtBegin   ? std::optional(begin)
                       : isForward ? m_at.packets.nextProblem(from.value_or(begin))
                                   : m_at.packets.previousProblem(from.value_or(m_at.view.digests().end()));
    found ? show(*found)
          : m_at.say(isForward ? tr("No problem after this packet.") : tr("No problem before this packet."));
}

void PacketNavigation::goToSameStream(Direction direction) {
    const bool isForward = direction == Direction::Forward;
    const auto from = m_at.selected();
    const std::uint64_t number = from.value_or(m_at.view.end() - 1);
    const auto packet = m_at.view.packet(number);
    const model::PacketDigest* wanted = m_at.view.digests().find(number);
    if (!packet || wanted == nullptr) {
        m_at.say(tr("No packet is selected."));
        return;
    }
    const auto isWanted = [&](std::uint64_t other) {
        const model::PacketDigest* candidate = m_at.view.digests().find(other);
        if (other == number || candidate == nullptr || candidate->type != wanted->type ||
            candidate->character != wanted->character) {
            return false;
        }
        const auto found = m_at.view.packet(other);
        return found && found->sender == packet->sender;
    };
    const int rows = m_at.packets.rowCount();
    int row = isForward ? (from ? m_at.packets.rowFrom(number + 1) : 0)
                        : (from ? m_at.packets.rowFrom(number) : rows) - 1;
    for (; row >= 0 && row < rows; row += isForward ? 1 : -1) {
        if (isWanted(m_at.packets.packetAt(row))) {
            show(m_at.packets.packetAt(row));
            return;
        }
    }
    m_at.say(isForward ? tr("No later packet of this stream.") : tr("No earlier packet of this stream."));
}

void PacketNavigation::goToMark(Direction direction) {
    const bool isForward = direction == Direction::Forward;
    std::vector<std::uint64_t> listed;
    std::ranges::copy_if(m_at.view.annotations().marks, std::back_inserter(listed),
                         [&](std::uint64_t number) { return m_at.packets.rowOf(number) >= 0; });
    const auto selected = m_at.selected();
    const std::uint64_t from = selected.value_or(isForward ? 0 : m_at.view.end());
    const auto after = selected && isForward ? std::ranges::upper_bound(listed, from)
                                             : std::ranges::lower_bound(listed, from);
    if (isForward ? after == listed.end() : after == listed.begin()) {
        m_at.say(isForward ? tr("No mark after this packet.") : tr("No mark before this packet."));
        return;
    }
    show(isForward ? *after : *(after - 1));
}

} // namespace posewire::gui
