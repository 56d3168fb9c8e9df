// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/packet_commands.h"

#include "app/gui/models/packet_choice.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/find_bar.h"
#include "app/gui/theme/widgets.h"

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr int kPollMs = 20;
/// More would fill the clipboard of the desktop for minutes.
constexpr std::size_t kMostCopied = 100'000;

} // namespace

PacketNavigation::PacketNavigation(PacketListing listing, FindBar& bar)
    : m_at(std::move(listing)), m_bar(bar) {
    m_poll.setInterval(kPollMs);
    m_poll.callOnTimeout([this] { takeResult(); });
}

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
    static_cast<void>(askForText(
        {tr("Go to packet"), tr("&Number, +n or -n, or a time"), tr("1204112, +100, 12.5 s, 10:42:17.508"),
         tr("Go")},
        [this](const QString& text) { return goTo(text); }, m_at.list.window()));
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
    const model::PacketDigests& digests = m_at.view.digests();
    const auto from = m_at.selected();
    std::optional<std::uint64_t> found;
    if (direction == Direction::Backward) {
        found = m_at.packets.previousProblem(from.value_or(digests.end()));
    } else {
        const model::PacketDigest* first = from ? nullptr : digests.find(digests.begin());
        const bool isAtBegin =
            first != nullptr && first->isProblem() && m_at.packets.rowOf(digests.begin()) >= 0;
        found = isAtBegin ? digests.begin() : m_at.packets.nextProblem(from.value_or(digests.begin()));
    }
    if (found) {
        show(*found);
    } else {
        m_at.say(direction == Direction::Forward ? tr("No problem after this packet.")
                                                 : tr("No problem before this packet."));
    }
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

void PacketNavigation::find(Direction direction) {
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

void PacketNavigation::takeResult() {
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
    show(*result->packet);
    const QString place = tr("in packet %1, byte %2").arg(grouped(*result->packet)).arg(result->offset);
    m_bar.say(result->isWrapped ? tr("%1 (wrapped around)").arg(place) : place, false);
}

std::vector<std::uint64_t> SelectedPackets::numbers() const {
    std::vector<std::uint64_t> numbers;
    for (const int row : m_at.list.selectedRows(kMostCopied)) {
        numbers.push_back(m_at.packets.packetAt(row));
    }
    if (const auto packet = m_at.selected(); numbers.empty() && packet) {
        numbers.push_back(*packet);
    }
    return numbers;
}

void SelectedPackets::copyRows(RowFormat format) {
    const std::vector<int> rows = m_at.list.selectedRows(kMostCopied);
    const bool isCsv = format == RowFormat::Csv;
    m_at.commands.copyText(isCsv ? packetRowsCsv(m_at.packets, rows) : packetRowsText(m_at.packets, rows));
    const QString said = isCsv ? tr("Rows copied as CSV: %1") : tr("Rows copied: %1");
    m_at.say(rows.empty() ? tr("No packet is selected.") : said.arg(grouped(rows.size())));
}

void SelectedPackets::copyCell() {
    const QModelIndex cell = m_at.list.currentIndex();
    if (!cell.isValid()) {
        m_at.say(tr("No packet is selected."));
        return;
    }
    m_at.commands.copyText(cell.data(Qt::DisplayRole).toString());
    m_at.say(tr("Cell copied"));
}

void SelectedPackets::copyBytes(ByteFormat format) {
    QString text;
    const std::vector<std::uint64_t> packets = numbers();
    for (const std::uint64_t number : packets) {
        const bool isSpaced = format != ByteFormat::Json && !text.isEmpty();
        text += (isSpaced ? QStringLiteral("\n") : QString()) + packetBytesText(m_at.view, number, format);
    }
    m_at.commands.copyText(text);
    m_at.say(packets.empty() ? tr("No packet is selected.")
                             : tr("Packets copied: %1").arg(grouped(packets.size())));
}

void SelectedPackets::toggleMark() {
    const auto packets = numbers();
    if (packets.empty()) {
        m_at.say(tr("No packet is selected."));
        return;
    }
    const auto& marks = m_at.view.annotations().marks;
    const bool areMarked =
        std::ranges::all_of(packets, [&](std::uint64_t number) { return marks.contains(number); });
    for (const std::uint64_t number : packets) {
        m_at.commands.setMarked(number, !areMarked);
    }
    m_at.refresh();
}

void SelectedPackets::editComment() {
    const auto packet = m_at.selected();
    if (!packet) {
        m_at.say(tr("No packet is selected."));
        return;
    }
    const auto& comments = m_at.view.annotations().comments;
    const auto before = comments.find(*packet);
    const auto comment = askForText(
        {tr("Comment on packet %1").arg(grouped(*packet)), tr("&Comment (leave empty to remove it)"),
         QString(), tr("Save"),
         before == comments.end() ? QString() : QString::fromStdString(before->second)},
        [](const QString&) { return QString(); }, m_at.list.window());
    if (comment) {
        m_at.commands.setComment(*packet, *comment);
        m_at.refresh();
    }
}

QString SelectedPackets::cellFilter() const {
    const QModelIndex cell = m_at.list.currentIndex();
    return cell.isValid() ? packetCellFilter(m_at.view, m_at.packets.packetAt(cell.row()), cell.column())
                          : QString();
}

void SelectedPackets::applyCell(FilterJoin join) {
    const QString condition = cellFilter();
    if (condition.isEmpty()) {
        m_at.say(m_at.list.currentIndex().isValid() ? tr("This cell has nothing to filter by.")
                                                    : tr("No packet is selected."));
        return;
    }
    m_at.commands.setDisplayFilter(
        joinedFilter(QString::fromStdString(m_at.view.displayFilter()), condition, join));
    m_at.refresh();
}

} // namespace posewire::gui
