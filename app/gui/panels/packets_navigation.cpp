// SPDX-License-Identifier: GPL-3.0-or-later
// Where the operator can go in the list of packets.
#include "app/gui/models/packet_target.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/filter_bar.h"
#include "app/gui/panels/find_bar.h"
#include "app/gui/panels/packet_view.h"
#include "app/gui/panels/packets_panel.h"
#include "app/gui/panels/text_prompt.h"

#include <algorithm>

namespace posewire::gui {

void PacketsPanel::showPacket(std::uint64_t number) {
    m_commands.selectPacket(number);
    m_list->setFollowing(false);
    refresh();
    if (m_packets.rowOf(number) < 0) {
        say(tr("Packet %1 is selected; the filter does not show it.").arg(grouped(number)));
    }
}

QString PacketsPanel::goTo(const QString& text) {
    const auto target = packetTarget(m_view, text);
    if (!target) {
        return target.error();
    }
    showPacket(*target);
    return {};
}

void PacketsPanel::goToPacket() {
    QString asked;
    TextPrompt prompt(
        {tr("Go to packet"), tr("&Number, +n or -n, or a time"), tr("1204112, +100, 12.5 s, 10:42:17.508"),
         tr("Go")},
        [&](const QString& text) { return goTo(text); }, this);
    prompt.exec();
}

template <class Condition>
void PacketsPanel::goToRow(bool isForward, const Condition& isWanted, const QString& nothing) {
    const int rows = m_packets.rowCount();
    const auto from = selected();
    int row =
        isForward ? (from ? m_packets.rowFrom(*from + 1) : 0) : (from ? m_packets.rowFrom(*from) : rows) - 1;
    for (; row >= 0 && row < rows; row += isForward ? 1 : -1) {
        if (isWanted(m_packets.packetAt(row))) {
            showPacket(m_packets.packetAt(row));
            return;
        }
    }
    say(nothing);
}

void PacketsPanel::goToProblem(bool isForward) {
    const auto from = selected();
    const bool isFirst = isForward && !from;
    const std::uint64_t begin = m_view.digests().begin();
    const model::PacketDigest* first = m_view.digests().find(begin);
    const bool isAtBegin = isFirst && first != nullptr && first->isProblem() && m_packets.rowOf(begin) >= 0;
    const auto found = isAtBegin   ? std::optional(begin)
                       : isForward ? m_packets.nextProblem(from.value_or(begin))
                                   : m_packets.previousProblem(from.value_or(m_view.digests().end()));
    found ? showPacket(*found)
          : say(isForward ? tr("No problem after this packet.") : tr("No problem before this packet."));
}

void PacketsPanel::nextProblem() {
    goToProblem(true);
}

void PacketsPanel::previousProblem() {
    goToProblem(false);
}

void PacketsPanel::firstPacket() {
    if (m_packets.rowCount() > 0) {
        showPacket(m_packets.packetAt(0));
    }
}

void PacketsPanel::newestPacket() {
    model::Selection selection = m_view.selection();
    selection.packet.reset();
    m_commands.select(selection);
    m_list->setFollowing(true);
    refresh();
}

void PacketsPanel::goToSameStream(bool isForward) {
    const std::uint64_t number = selected().value_or(m_view.end() - 1);
    const auto packet = m_view.packet(number);
    const model::PacketDigest* digest = m_view.digests().find(number);
    if (!packet || digest == nullptr) {
        say(tr("No packet is selected."));
        return;
    }
    const log::SenderId sender = packet->sender;
    const model::PacketDigest wanted = *digest;
    goToRow(
        isForward,
        [&](std::uint64_t other) {
            const model::PacketDigest* candidate = m_view.digests().find(other);
            if (other == number || candidate == nullptr || candidate->type != wanted.type ||
                candidate->character != wanted.character) {
                return false;
            }
            const auto found = m_view.packet(other);
            return found && found->sender == sender;
        },
        isForward ? tr("No later packet of this stream.") : tr("No earlier packet of this stream."));
}

void PacketsPanel::nextOfStream() {
    goToSameStream(true);
}

void PacketsPanel::previousOfStream() {
    goToSameStream(false);
}

void PacketsPanel::goToMark(bool isForward) {
    const auto& marks = m_view.annotations().marks;
    std::vector<std::uint64_t> listed;
    std::ranges::copy_if(marks, std::back_inserter(listed),
                         [&](std::uint64_t number) { return m_packets.rowOf(number) >= 0; });
    const std::uint64_t from = selected().value_or(isForward ? 0 : m_view.end());
    const auto after = selected() && isForward ? std::ranges::upper_bound(listed, from)
                                               : std::ranges::lower_bound(listed, from);
    if (isForward ? after == listed.end() : after == listed.begin()) {
        say(isForward ? tr("No mark after this packet.") : tr("No mark before this packet."));
        return;
    }
    showPacket(isForward ? *after : *(after - 1));
}

void PacketsPanel::nextMark() {
    goToMark(true);
}

void PacketsPanel::previousMark() {
    goToMark(false);
}

void PacketsPanel::focusFilter() {
    m_filter->focusLine();
}

void PacketsPanel::find() {
    m_find->open();
}

void PacketsPanel::findNext() {
    search(true);
}

void PacketsPanel::findPrevious() {
    search(false);
}

void PacketsPanel::search(bool isForward) {
    if (m_find->text().isEmpty()) {
        m_find->open();
        return;
    }
    auto pattern = parsePattern(m_find->text(), m_find->isHexadecimal());
    if (!pattern) {
        m_find->open();
        m_find->say(pattern.error(), true);
        return;
    }
    PacketSearch::Request request{*std::move(pattern), selected().value_or(m_view.end()), isForward, {}};
    if (m_packets.isFiltered()) {
        request.among = m_packets.matches();
        if (request.among.empty()) {
            m_find->say(tr("No packet is listed"), true);
            return;
        }
    }
    m_search = std::make_unique<PacketSearch>(m_view.log(), std::move(request));
    m_find->say(tr("Looking …"), false);
    m_searchTimer.start();
}

void PacketsPanel::takeSearchResult() {
    const auto result = m_search ? m_search->result() : std::nullopt;
    if (!result) {
        return;
    }
    m_searchTimer.stop();
    m_search.reset();
    if (!result->packet) {
        m_find->say(tr("Found nowhere"), true);
        return;
    }
    showPacket(*result->packet);
    const QString place = tr("in packet %1, byte %2").arg(grouped(*result->packet)).arg(result->offset);
    m_find->say(result->isWrapped ? tr("%1 (went around)").arg(place) : place, false);
}

} // namespace posewire::gui
