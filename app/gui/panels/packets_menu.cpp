// SPDX-License-Identifier: GPL-3.0-or-later
// What the operator can do with the selected packets: copy, mark, comment, filter by a cell.
#include "app/gui/models/text.h"
#include "app/gui/panels/packet_view.h"
#include "app/gui/panels/packets_panel.h"
#include "app/gui/panels/text_prompt.h"

#include <QAction>
#include <QMenu>

#include <algorithm>

namespace posewire::gui {

namespace {

/// More would fill the clipboard of the desktop for minutes.
constexpr std::size_t kMostCopied = 100'000;

} // namespace

std::vector<std::uint64_t> PacketsPanel::selectedPackets() const {
    std::vector<std::uint64_t> numbers;
    for (const int row : m_list->selectedRows(kMostCopied)) {
        numbers.push_back(m_packets.packetAt(row));
    }
    if (const auto packet = selected(); numbers.empty() && packet) {
        numbers.push_back(*packet);
    }
    return numbers;
}

void PacketsPanel::copyRows() {
    const std::vector<int> rows = m_list->selectedRows(kMostCopied);
    m_commands.copyText(packetRowsText(m_packets, rows));
    say(rows.empty() ? tr("No packet is selected.") : tr("Rows copied: %1").arg(grouped(rows.size())));
}

void PacketsPanel::copyCsv() {
    const std::vector<int> rows = m_list->selectedRows(kMostCopied);
    m_commands.copyText(packetRowsCsv(m_packets, rows));
    say(rows.empty() ? tr("No packet is selected.") : tr("Rows copied as CSV: %1").arg(grouped(rows.size())));
}

void PacketsPanel::copyCell() {
    const QModelIndex cell = m_list->currentIndex();
    if (!cell.isValid()) {
        say(tr("No packet is selected."));
        return;
    }
    m_commands.copyText(cell.data(Qt::DisplayRole).toString());
    say(tr("Cell copied"));
}

void PacketsPanel::copyBytes(ByteFormat format) {
    QString text;
    const std::vector<std::uint64_t> numbers = selectedPackets();
    for (const std::uint64_t number : numbers) {
        const bool isSpaced = format != ByteFormat::Json && !text.isEmpty();
        text += (isSpaced ? QStringLiteral("\n") : QString()) + packetBytesText(m_view, number, format);
    }
    m_commands.copyText(text);
    say(numbers.empty() ? tr("No packet is selected.")
                        : tr("Packets copied: %1").arg(grouped(numbers.size())));
}

void PacketsPanel::copyBytesText() {
    copyBytes(ByteFormat::Text);
}

void PacketsPanel::copyBytesRaw() {
    copyBytes(ByteFormat::Raw);
}

void PacketsPanel::copyBytesCArray() {
    copyBytes(ByteFormat::CArray);
}

void PacketsPanel::copyBytesJson() {
    copyBytes(ByteFormat::Json);
}

void PacketsPanel::toggleMark() {
    const auto packets = selectedPackets();
    if (packets.empty()) {
        say(tr("No packet is selected."));
        return;
    }
    const auto& marks = m_view.annotations().marks;
    const bool areMarked =
        std::ranges::all_of(packets, [&](std::uint64_t number) { return marks.contains(number); });
    for (const std::uint64_t number : packets) {
        m_commands.setMarked(number, !areMarked);
    }
    refresh();
}

void PacketsPanel::editComment() {
    const auto packet = selected();
    if (!packet) {
        say(tr("No packet is selected."));
        return;
    }
    const auto& comments = m_view.annotations().comments;
    const auto before = comments.find(*packet);
    TextPrompt prompt({tr("Comment on packet %1").arg(grouped(*packet)),
                       tr("&Comment (empty to take it away)"), QString(), tr("Save"),
                       before == comments.end() ? QString() : QString::fromStdString(before->second)},
                      {}, this);
    if (prompt.exec() == QDialog::Accepted) {
        m_commands.setComment(*packet, prompt.text());
        refresh();
    }
}

void PacketsPanel::applyCell(FilterJoin join) {
    const QModelIndex cell = m_list->currentIndex();
    const QString condition =
        cell.isValid() ? packetCellFilter(m_view, m_packets.packetAt(cell.row()), cell.column()) : QString();
    if (condition.isEmpty()) {
        say(cell.isValid() ? tr("This cell says nothing that could be filtered by.")
                           : tr("No packet is selected."));
        return;
    }
    m_commands.setDisplayFilter(
        joinedFilter(QString::fromStdString(m_view.displayFilter()), condition, join));
    refresh();
}

void PacketsPanel::filterByCell() {
    applyCell(FilterJoin::Replace);
}

void PacketsPanel::filterAndCell() {
    applyCell(FilterJoin::And);
}

void PacketsPanel::filterOrCell() {
    applyCell(FilterJoin::Or);
}

void PacketsPanel::filterNotCell() {
    applyCell(FilterJoin::AndNot);
}

void PacketsPanel::addFilterMenu(QMenu& menu) {
    const QModelIndex cell = m_list->currentIndex();
    const QString condition =
        cell.isValid() ? packetCellFilter(m_view, m_packets.packetAt(cell.row()), cell.column()) : QString();
    QString shown =
        fontMetrics().elidedText(condition, Qt::ElideRight, fontMetrics().averageCharWidth() * 50);
    shown.replace(QLatin1Char('&'), QLatin1String("&&"));
    QAction* title =
        menu.addAction(condition.isEmpty() ? tr("Apply as filter") : tr("Apply as filter: %1").arg(shown),
                       this, &PacketsPanel::filterByCell);
    title->setEnabled(!condition.isEmpty());
    const std::pair<QString, void (PacketsPanel::*)()> joins[] = {
        {tr("… and"), &PacketsPanel::filterAndCell},
        {tr("… or"), &PacketsPanel::filterOrCell},
        {tr("… and not"), &PacketsPanel::filterNotCell}};
    for (const auto& [text, slot] : joins) {
        menu.addAction(text, this, slot)->setEnabled(!condition.isEmpty());
    }
}

void PacketsPanel::addCopyMenu(QMenu& menu) {
    const bool isEnabled = !selectedPackets().empty();
    QMenu* copy = menu.addMenu(tr("&Copy"));
    copy->setEnabled(isEnabled);
    copy->addAction(tr("&Rows as text"), this, &PacketsPanel::copyRows);
    copy->addAction(tr("Rows as C&SV"), this, &PacketsPanel::copyCsv);
    copy->addAction(tr("Ce&ll"), this, &PacketsPanel::copyCell);
    copy->addSeparator();
    copy->addAction(tr("Bytes as &hexadecimal text"), this, &PacketsPanel::copyBytesText);
    copy->addAction(tr("Bytes as ra&w hexadecimal"), this, &PacketsPanel::copyBytesRaw);
    copy->addAction(tr("Bytes as C &array"), this, &PacketsPanel::copyBytesCArray);
    copy->addAction(tr("Packet as &JSON"), this, &PacketsPanel::copyBytesJson);
}

void PacketsPanel::addTimeMenu(QMenu& menu) {
    QMenu* times = menu.addMenu(tr("&Times"));
    const auto add = [&](const QString& text, bool isChecked, void (PacketsPanel::*slot)()) {
        QAction* action = times->addAction(text, this, slot);
        action->setCheckable(true);
        action->setChecked(isChecked);
    };
    add(tr("Since the &first packet"), !isTimeOfDay(), &PacketsPanel::timeSinceFirst);
    add(tr("Date and time of &day"), isTimeOfDay(), &PacketsPanel::timeOfDay);
    times->addSeparator();
    add(tr("Δ to the packet before in its &stream"), !isDeltaToRowAbove(), &PacketsPanel::deltaInStream);
    add(tr("Δ to the row &above"), isDeltaToRowAbove(), &PacketsPanel::deltaToRowAbove);
}

void PacketsPanel::showMenu(const QPoint& globalPlace) {
    QMenu menu(this);
    addFilterMenu(menu);
    menu.addSeparator();
    addCopyMenu(menu);
    const bool isEnabled = !selectedPackets().empty();
    menu.addAction(tr("&Mark"), this, &PacketsPanel::toggleMark)->setEnabled(isEnabled);
    menu.addAction(tr("C&omment…"), this, &PacketsPanel::editComment)->setEnabled(isEnabled);
    menu.addSeparator();
    menu.addAction(tr("&Next of this stream"), this, &PacketsPanel::nextOfStream)->setEnabled(isEnabled);
    menu.addAction(tr("&Previous of this stream"), this, &PacketsPanel::previousOfStream)
        ->setEnabled(isEnabled);
    addTimeMenu(menu);
    menu.exec(globalPlace);
}

} // namespace posewire::gui
