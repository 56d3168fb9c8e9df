// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/selected_packets.h"

#include "app/gui/models/text.h"
#include "app/gui/panels/text_prompt.h"

#include <algorithm>

namespace posewire::gui {

namespace {

/// More would fill the clipboard of the desktop for minutes.
constexpr std::size_t kMostCopied = 100'000;

} // namespace

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
    TextPrompt prompt({tr("Comment on packet %1").arg(grouped(*packet)),
                       tr("&Comment (leave empty to remove it)"), QString(), tr("Save"),
                       before == comments.end() ? QString() : QString::fromStdString(before->second)},
                      {}, m_at.list.window());
    if (prompt.exec() == QDialog::Accepted) {
        m_at.commands.setComment(*packet, prompt.text());
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
