// SPDX-License-Identifier: GPL-3.0-or-later
// What the operator can do in the list of packets, and the menus that offer it.
#include "app/gui/models/packet_choice.h"

#include "app/gui/base/saving.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/filter_bar.h"
#include "app/gui/panels/packets_panel.h"

#include <QMenu>

#include <algorithm>

namespace posewire::gui {

namespace {

/// More would fill the clipboard of the desktop for minutes.
constexpr std::size_t kMostCopied = 100'000;

std::vector<int> selectedRowsOf(const QItemSelectionModel& selection) {
    std::vector<std::pair<int, int>> ranges;
    for (const QItemSelectionRange& range : selection.selection()) {
        ranges.emplace_back(range.top(), range.bottom());
    }
    std::ranges::sort(ranges);
    std::vector<int> rows;
    for (const auto& [first, last] : ranges) {
        for (int row = first; row <= last && rows.size() < kMostCopied; ++row) {
            rows.push_back(row);
        }
    }
    return rows;
}

constexpr const char* kEdit = QT_TRANSLATE_NOOP("Action", "&Edit");
constexpr const char* kCopy = QT_TRANSLATE_NOOP("Action", "&Edit/Co&py packets");
constexpr const char* kSavedFiltersMenu = QT_TRANSLATE_NOOP("Action", "&Edit/Saved fil&ters");
constexpr const char* kCell = QT_TRANSLATE_NOOP("Action", "&Edit/&Apply cell as filter");
constexpr const char* kTimes = QT_TRANSLATE_NOOP("Action", "&View/&Packet times");
constexpr const char* kGo = QT_TRANSLATE_NOOP("Action", "&Go");

} // namespace

/// A part of the panel, so that its entries reach what is private there.
struct PacketsPanel::Actions {
    using Do = ActionsOf<PacketsPanel>;
    using Time = PacketModel::TimeMode;
    using Delta = PacketModel::DeltaMode;

    static constexpr auto kForward = Direction::Forward;
    static constexpr auto kBackward = Direction::Backward;

    static constexpr ActionInfo kTable[] = {
        {"mark", kEdit, QT_TRANSLATE_NOOP("Action", "&Mark packet"), "Ctrl+M",
         Do::call<&PacketsPanel::toggleMark>, Do::is<&PacketsPanel::areMarked>},
        {"comment", kEdit, QT_TRANSLATE_NOOP("Action", "&Comment on packet…"), "Ctrl+Alt+C",
         Do::call<&PacketsPanel::editComment>},
        lineIn(kEdit),
        {"copyRows", kCopy, QT_TRANSLATE_NOOP("Action", "&Rows as text"), "",
         Do::call<&PacketsPanel::copy, Copied::Rows>},
        {"copyCsv", kCopy, QT_TRANSLATE_NOOP("Action", "Rows as C&SV"), "",
         Do::call<&PacketsPanel::copy, Copied::Csv>},
        {"copyCell", kCopy, QT_TRANSLATE_NOOP("Action", "Ce&ll"), "",
         Do::call<&PacketsPanel::copy, Copied::Cell>},
        lineIn(kCopy),
        {"copyBytesText", kCopy, QT_TRANSLATE_NOOP("Action", "Bytes as &hexadecimal text"), "Ctrl+Shift+C",
         Do::call<&PacketsPanel::copyBytes, ByteFormat::Text>},
        {"copyBytesRaw", kCopy, QT_TRANSLATE_NOOP("Action", "Bytes as ra&w hexadecimal"), "",
         Do::call<&PacketsPanel::copyBytes, ByteFormat::Raw>},
        {"copyBytesCArray", kCopy, QT_TRANSLATE_NOOP("Action", "Bytes as C &array"), "",
         Do::call<&PacketsPanel::copyBytes, ByteFormat::CArray>},
        {"copyBytesJson", kCopy, QT_TRANSLATE_NOOP("Action", "Packets as &JSON"), "",
         Do::call<&PacketsPanel::copyBytes, ByteFormat::Json>},
        lineIn(kEdit),
        {"filter", kEdit, QT_TRANSLATE_NOOP("Action", "&Filter packets"), "Ctrl+L",
         Do::callIn<&PacketsPanel::m_filterBar, &FilterBar::focusLine>},
        listIn(kSavedFiltersMenu, Do::listOf<&PacketsPanel::m_filterBar, &FilterBar::listSaved>),
        {"saveFilter", kEdit, QT_TRANSLATE_NOOP("Action", "&Save filter as a button…"), "",
         Do::callIn<&PacketsPanel::m_filterBar, &FilterBar::saveCurrent>},
        {"filterByCell", kCell, QT_TRANSLATE_NOOP("Action", "&Only this"), "Ctrl+Shift+L",
         Do::call<&PacketsPanel::applyCell, FilterJoin::Replace>},
        {"filterAndCell", kCell, QT_TRANSLATE_NOOP("Action", "… &and"), "",
         Do::call<&PacketsPanel::applyCell, FilterJoin::And>},
        {"filterOrCell", kCell, QT_TRANSLATE_NOOP("Action", "… o&r"), "",
         Do::call<&PacketsPanel::applyCell, FilterJoin::Or>},
        {"filterNotCell", kCell, QT_TRANSLATE_NOOP("Action", "… and &not"), "",
         Do::call<&PacketsPanel::applyCell, FilterJoin::AndNot>},
        lineIn(kEdit),
        {"find", kEdit, QT_TRANSLATE_NOOP("Action", "Find &bytes or text…"), "Ctrl+F",
         Do::callIn<&PacketsPanel::m_find, &FindBar::open>},
        {"findNext", kEdit, QT_TRANSLATE_NOOP("Action", "Find ne&xt"), "F3",
         Do::call<&PacketsPanel::find, kForward>},
        {"findPrevious", kEdit, QT_TRANSLATE_NOOP("Action", "Find pre&vious"), "Shift+F3",
         Do::call<&PacketsPanel::find, kBackward>},

        {"timeSinceFirst", kTimes, QT_TRANSLATE_NOOP("Action", "Since the &first packet"), "",
         Do::callIn<&PacketsPanel::m_packets, &PacketModel::setTimeMode, Time::SinceFirst>,
         Do::isIn<&PacketsPanel::m_packets, &PacketModel::timeMode, Time::SinceFirst>},
        {"timeOfDay", kTimes, QT_TRANSLATE_NOOP("Action", "Date and time of &day"), "",
         Do::callIn<&PacketsPanel::m_packets, &PacketModel::setTimeMode, Time::TimeOfDay>,
         Do::isIn<&PacketsPanel::m_packets, &PacketModel::timeMode, Time::TimeOfDay>},
        {"deltaInStream", kTimes, QT_TRANSLATE_NOOP("Action", "Δ to the packet before in its &stream"), "",
         Do::callIn<&PacketsPanel::m_packets, &PacketModel::setDeltaMode, Delta::Stream>,
         Do::isIn<&PacketsPanel::m_packets, &PacketModel::deltaMode, Delta::Stream>},
        {"deltaToRowAbove", kTimes, QT_TRANSLATE_NOOP("Action", "Δ to the row &above"), "",
         Do::callIn<&PacketsPanel::m_packets, &PacketModel::setDeltaMode, Delta::RowAbove>,
         Do::isIn<&PacketsPanel::m_packets, &PacketModel::deltaMode, Delta::RowAbove>},

        {"goToPacket", kGo, QT_TRANSLATE_NOOP("Action", "&Go to packet…"), "G",
         Do::call<&PacketsPanel::askForPacket>},
        lineIn(kGo),
        {"nextProblem", kGo, QT_TRANSLATE_NOOP("Action", "&Next problem of the selected character"), "N",
         Do::call<&PacketsPanel::go, Landmark::ProblemOfSelected, kForward>},
        {"previousProblem", kGo, QT_TRANSLATE_NOOP("Action", "&Previous problem of the selected character"),
         "Shift+N", Do::call<&PacketsPanel::go, Landmark::ProblemOfSelected, kBackward>},
        {"nextProblemOfAny", kGo, QT_TRANSLATE_NOOP("Action", "Next problem of anybo&dy"), "Alt+N",
         Do::call<&PacketsPanel::go, Landmark::Problem, kForward>},
        {"previousProblemOfAny", kGo, QT_TRANSLATE_NOOP("Action", "Previous problem of an&ybody"),
         "Alt+Shift+N", Do::call<&PacketsPanel::go, Landmark::Problem, kBackward>},
        lineIn(kGo),
        {"nextOfStream", kGo, QT_TRANSLATE_NOOP("Action", "Next packet of the &stream"), "Alt+.",
         Do::call<&PacketsPanel::go, Landmark::SameStream, kForward>},
        {"previousOfStream", kGo, QT_TRANSLATE_NOOP("Action", "Previous packet of the s&tream"), "Alt+,",
         Do::call<&PacketsPanel::go, Landmark::SameStream, kBackward>},
        lineIn(kGo),
        {"nextMark", kGo, QT_TRANSLATE_NOOP("Action", "Next &mark"), "Ctrl+Shift+N",
         Do::call<&PacketsPanel::go, Landmark::Mark, kForward>},
        {"previousMark", kGo, QT_TRANSLATE_NOOP("Action", "Previous m&ark"), "Ctrl+Shift+B",
         Do::call<&PacketsPanel::go, Landmark::Mark, kBackward>},
        lineIn(kGo),
        {"firstPacket", kGo, QT_TRANSLATE_NOOP("Action", "&First packet"), "Ctrl+Home",
         Do::call<&PacketsPanel::go, Landmark::First, kBackward>},
        {"newestPacket", kGo, QT_TRANSLATE_NOOP("Action", "Ne&west packet, and follow"), "Ctrl+End",
         Do::call<&PacketsPanel::goToNewest>},
    };
};

std::span<const ActionInfo> PacketsPanel::actionTable() {
    return Actions::kTable;
}

/// Filters by the current cell, and what the window's menus do with the selected packets.
void PacketsPanel::showMenu(const QPoint& globalPlace) {
    QMenu menu(this);
    const QString condition = cellFilter();
    QString shown =
        fontMetrics().elidedText(condition, Qt::ElideRight, fontMetrics().averageCharWidth() * 50);
    shown.replace(QLatin1Char('&'), QLatin1String("&&"));
    const std::pair<QString, FilterJoin> joins[] = {
        {condition.isEmpty() ? tr("Apply as filter") : tr("Apply as filter: %1").arg(shown),
         FilterJoin::Replace},
        {tr("… and"), FilterJoin::And},
        {tr("… or"), FilterJoin::Or},
        {tr("… and not"), FilterJoin::AndNot}};
    for (const auto& [text, join] : joins) {
        menu.addAction(text, this, [this, join = join] { applyCell(join); })
            ->setEnabled(!condition.isEmpty());
    }
    menu.addSeparator();
    const bool hasPacket = !meantPackets(Meant::Selected).empty();
    QMenu* copy = menu.addMenu(tr("&Copy"));
    addEntries(*copy, actionTable(), kCopy, *this);
    const auto add = [&](const QString& text, auto carryOut) {
        menu.addAction(text, this, carryOut)->setEnabled(hasPacket);
    };
    copy->setEnabled(hasPacket);
    add(areMarked() ? tr("Un&mark") : tr("&Mark"), &PacketsPanel::toggleMark);
    add(tr("C&omment…"), &PacketsPanel::editComment);
    menu.addSeparator();
    add(tr("&Next of this stream"), [this] { go(Landmark::SameStream, Direction::Forward); });
    add(tr("&Previous of this stream"), [this] { go(Landmark::SameStream, Direction::Backward); });
    addEntries(*menu.addMenu(tr("&Times")), actionTable(), kTimes, *this);
    menu.exec(globalPlace);
}

void PacketsPanel::showPacket(std::uint64_t number) {
    m_commands.selectPacket(number);
    m_list->setFollowing(false);
    refresh();
    if (m_packets.rowOf(number) < 0) {
        say(tr("Packet %1 is selected, but the filter hides it.").arg(grouped(number)));
    }
}

QString PacketsPanel::goTo(const QString& text) {
    const auto target = packetTarget(m_view, text);
    if (!target) {
        return target.error();
    }
    if (!m_view.packet(*target)) {
        return tr("Packet %1 cannot be read any more: the file that it lies in was changed.")
            .arg(grouped(*target));
    }
    showPacket(*target);
    return {};
}

void PacketsPanel::askForPacket() {
    static_cast<void>(askForText(
        {tr("Go to packet"), tr("&Number, +n or -n, or a time"), tr("1204112, +100, 12.5 s, 10:42:17.508"),
         tr("Go")},
        [this](const QString& text) { return goTo(text); }, window()));
}

void PacketsPanel::goToNewest() {
    m_commands.unselectPacket();
    m_list->setFollowing(true);
    refresh();
}

void PacketsPanel::go(Landmark landmark, Direction direction) {
    if (const auto found = nearestListed(m_view, m_packets, landmark, direction)) {
        showPacket(*found);
    } else {
        say(found.error());
    }
}

void PacketsPanel::find(Direction direction) {
    m_find->find(m_view.log(), m_packets, m_view.choices().selection.packet.value_or(m_view.end()),
                 direction);
}

std::vector<std::uint64_t> PacketsPanel::meantPackets(Meant meant) const {
    std::vector<std::uint64_t> numbers;
    for (const int row : selectedRowsOf(*m_list->selectionModel())) {
        numbers.push_back(m_packets.packetAt(row));
    }
    if (const auto packet = m_view.choices().selection.packet; numbers.empty() && packet) {
        numbers.push_back(*packet);
    }
    if (numbers.empty() && meant == Meant::OrNewest && m_view.end() != m_view.begin()) {
        numbers.push_back(newestVisiblePacket(m_view));
    }
    return numbers;
}

void PacketsPanel::copy(Copied what) {
    const QModelIndex cell = m_list->currentIndex();
    const std::vector<int> rows = selectedRowsOf(*m_list->selectionModel());
    if (what == Copied::Cell ? !cell.isValid() : rows.empty()) {
        say(tr("No packet is selected."));
        return;
    }
    copyText(what == Copied::Cell   ? cell.data().toString()
             : what == Copied::Rows ? packetRowsText(m_packets, rows)
                                    : packetRowsCsv(m_packets, rows));
    say(what == Copied::Cell ? tr("Cell copied")
                             : (what == Copied::Csv ? tr("Rows copied as CSV: %1") : tr("Rows copied: %1"))
                                   .arg(grouped(rows.size())));
}

void PacketsPanel::copyBytes(ByteFormat format) {
    const std::vector<std::uint64_t> packets = meantPackets(Meant::Selected);
    if (packets.empty()) {
        say(tr("No packet is selected."));
        return;
    }
    QStringList texts;
    for (const std::uint64_t number : packets) {
        texts += packetBytesText(m_view, number, format);
    }
    copyText(texts.join(format == ByteFormat::Json ? QString() : QStringLiteral("\n")));
    say(tr("Packets copied: %1").arg(grouped(packets.size())));
}

bool PacketsPanel::areMarked() const {
    const auto packets = meantPackets(Meant::OrNewest);
    const auto& marks = m_view.choices().annotations.marks;
    return !packets.empty() &&
           std::ranges::all_of(packets, [&](std::uint64_t number) { return marks.contains(number); });
}

void PacketsPanel::toggleMark() {
    const auto packets = meantPackets(Meant::OrNewest);
    if (packets.empty()) {
        say(tr("No packet is selected."));
        return;
    }
    const bool isMarked = !areMarked();
    for (const std::uint64_t number : packets) {
        m_commands.setMarked(number, isMarked);
    }
    if (meantPackets(Meant::Selected).empty()) {
        const QString number = grouped(packets.front());
        say(isMarked ? tr("Packet %1 is marked.").arg(number)
                     : tr("Packet %1 is not marked any more.").arg(number));
    }
    refresh();
}

void PacketsPanel::editComment() {
    const std::vector<std::uint64_t> meant = meantPackets(Meant::OrNewest);
    if (meant.empty()) {
        say(tr("No packet is selected."));
        return;
    }
    const std::uint64_t packet = m_view.choices().selection.packet.value_or(meant.front());
    const auto& comments = m_view.choices().annotations.comments;
    const auto before = comments.find(packet);
    const auto comment = askForText(
        {tr("Comment on packet %1").arg(grouped(packet)), tr("&Comment (leave empty to remove it)"),
         QString(), tr("Save"),
         before == comments.end() ? QString() : QString::fromStdString(before->second)},
        [](const QString&) { return QString(); }, window());
    if (comment) {
        m_commands.setComment(packet, *comment);
        refresh();
    }
}

QString PacketsPanel::cellFilter() const {
    const QModelIndex cell = m_list->currentIndex();
    return cell.isValid() ? packetCellFilter(m_view, m_packets.packetAt(cell.row()), cell.column())
                          : QString();
}

void PacketsPanel::applyCell(FilterJoin join) {
    const QString condition = cellFilter();
    if (condition.isEmpty()) {
        say(m_list->currentIndex().isValid() ? tr("This cell has nothing to filter by.")
                                             : tr("No packet is selected."));
        return;
    }
    m_commands.setDisplayFilter(
        joinedFilter(QString::fromStdString(m_view.choices().displayFilter), condition, join));
    refresh();
}

} // namespace posewire::gui
