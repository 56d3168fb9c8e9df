// SPDX-License-Identifier: GPL-3.0-or-later
// What the operator can do in the list of packets, and the menus that offer it.
#include "app/gui/models/packet_choice.h"

#include "app/gui/base/saving.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/filter_bar.h"
#include "app/gui/panels/packets_panel.h"
#include "core/model/session/accounts.h"

#include <QMenu>

#include <algorithm>

namespace posewire::gui {

namespace {

/// More would fill the clipboard of the desktop for minutes.
constexpr std::size_t kMostCopied = 100'000;

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
         Do::call<&PacketsPanel::copyRows, RowFormat::Text>},
        {"copyCsv", kCopy, QT_TRANSLATE_NOOP("Action", "Rows as C&SV"), "",
         Do::call<&PacketsPanel::copyRows, RowFormat::Csv>},
        {"copyCell", kCopy, QT_TRANSLATE_NOOP("Action", "Ce&ll"), "", Do::call<&PacketsPanel::copyCell>},
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
         Do::callIn<&PacketsPanel::m_filter, &FilterBar::focusLine>},
        listIn(kSavedFiltersMenu, Do::listOf<&PacketsPanel::m_filter, &FilterBar::listSaved>),
        {"saveFilter", kEdit, QT_TRANSLATE_NOOP("Action", "&Save filter as a button…"), "",
         Do::callIn<&PacketsPanel::m_filter, &FilterBar::saveCurrent>},
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
         Do::call<&PacketsPanel::search, kForward>},
        {"findPrevious", kEdit, QT_TRANSLATE_NOOP("Action", "Find pre&vious"), "Shift+F3",
         Do::call<&PacketsPanel::search, kBackward>},

        {"timeSinceFirst", kTimes, QT_TRANSLATE_NOOP("Action", "Since the &first packet"), "",
         Do::call<&PacketsPanel::setTimeMode, Time::SinceFirst>,
         Do::is<&PacketsPanel::timeMode, Time::SinceFirst>},
        {"timeOfDay", kTimes, QT_TRANSLATE_NOOP("Action", "Date and time of &day"), "",
         Do::call<&PacketsPanel::setTimeMode, Time::TimeOfDay>,
         Do::is<&PacketsPanel::timeMode, Time::TimeOfDay>},
        {"deltaInStream", kTimes, QT_TRANSLATE_NOOP("Action", "Δ to the packet before in its &stream"), "",
         Do::callIn<&PacketsPanel::m_packets, &PacketModel::setDeltaMode, Delta::Stream>,
         Do::is<&PacketsPanel::deltaMode, Delta::Stream>},
        {"deltaToRowAbove", kTimes, QT_TRANSLATE_NOOP("Action", "Δ to the row &above"), "",
         Do::callIn<&PacketsPanel::m_packets, &PacketModel::setDeltaMode, Delta::RowAbove>,
         Do::is<&PacketsPanel::deltaMode, Delta::RowAbove>},

        {"goToPacket", kGo, QT_TRANSLATE_NOOP("Action", "&Go to packet…"), "G",
         Do::call<&PacketsPanel::askForPacket>},
        {"back", kGo, QT_TRANSLATE_NOOP("Action", "&Back to before the jump"), "Alt+Left",
         Do::call<&PacketsPanel::goBack>},
        lineIn(kGo),
        {"nextProblem", kGo, QT_TRANSLATE_NOOP("Action", "&Next problem of the selected character"), "N",
         Do::call<&PacketsPanel::goToProblem, kForward, ProblemsOf::Selected>},
        {"previousProblem", kGo, QT_TRANSLATE_NOOP("Action", "&Previous problem of the selected character"),
         "Shift+N", Do::call<&PacketsPanel::goToProblem, kBackward, ProblemsOf::Selected>},
        {"nextProblemOfAny", kGo, QT_TRANSLATE_NOOP("Action", "Next problem of anybo&dy"), "Alt+N",
         Do::call<&PacketsPanel::goToProblem, kForward, ProblemsOf::Anybody>},
        {"previousProblemOfAny", kGo, QT_TRANSLATE_NOOP("Action", "Previous problem of an&ybody"),
         "Alt+Shift+N", Do::call<&PacketsPanel::goToProblem, kBackward, ProblemsOf::Anybody>},
        lineIn(kGo),
        {"nextOfStream", kGo, QT_TRANSLATE_NOOP("Action", "Next packet of the &stream"), "Ctrl+.",
         Do::call<&PacketsPanel::goToSameStream, kForward>},
        {"previousOfStream", kGo, QT_TRANSLATE_NOOP("Action", "Previous packet of the s&tream"), "Ctrl+,",
         Do::call<&PacketsPanel::goToSameStream, kBackward>},
        lineIn(kGo),
        {"nextMark", kGo, QT_TRANSLATE_NOOP("Action", "Next &mark"), "Ctrl+Shift+N",
         Do::call<&PacketsPanel::goToMark, kForward>},
        {"previousMark", kGo, QT_TRANSLATE_NOOP("Action", "Previous m&ark"), "Ctrl+Shift+B",
         Do::call<&PacketsPanel::goToMark, kBackward>},
        lineIn(kGo),
        {"firstPacket", kGo, QT_TRANSLATE_NOOP("Action", "&First packet"), "Ctrl+Home",
         Do::call<&PacketsPanel::goToFirst>},
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
    const bool hasPacket = !selectedPackets().empty();
    QMenu* copy = menu.addMenu(tr("&Copy"));
    addEntries(*copy, actionTable(), kCopy, *this);
    const auto add = [&](const QString& text, auto carryOut) {
        menu.addAction(text, this, carryOut)->setEnabled(hasPacket);
    };
    copy->setEnabled(hasPacket);
    add(areMarked() ? tr("Un&mark") : tr("&Mark"), &PacketsPanel::toggleMark);
    add(tr("C&omment…"), &PacketsPanel::editComment);
    menu.addSeparator();
    add(tr("&Next of this stream"), [this] { goToSameStream(Direction::Forward); });
    add(tr("&Previous of this stream"), [this] { goToSameStream(Direction::Backward); });
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

void PacketsPanel::goToFirst() {
    if (m_packets.rowCount() > 0) {
        showPacket(m_packets.packetAt(0));
    }
}

void PacketsPanel::goToNewest() {
    model::Selection selection = m_view.choices().selection;
    selection.packet.reset();
    m_commands.select(selection);
    m_list->setFollowing(true);
    refresh();
}

void PacketsPanel::goToProblem(Direction direction, ProblemsOf of) {
    const bool isForward = direction == Direction::Forward;
    const auto& selected = m_view.choices().selection.character;
    const bool isOfOne = of == ProblemsOf::Selected && selected && !m_packets.isFiltered();
    const auto isWanted = [&](std::uint64_t packet) { return !isOfOne || m_packets.isOf(*selected, packet); };
    const auto step = [&](std::uint64_t from) {
        return isForward ? m_packets.nextProblem(from) : m_packets.previousProblem(from);
    };
    const model::PacketDigests& digests = m_view.accounts().digests();
    const auto from = m_view.choices().selection.packet;
    const model::PacketDigest* first = from || !isForward ? nullptr : digests.find(digests.begin());
    const bool isAtBegin = first != nullptr && first->isProblem() && m_packets.rowOf(digests.begin()) >= 0;
    std::optional<std::uint64_t> found =
        isAtBegin ? digests.begin() : step(from.value_or(isForward ? digests.begin() : digests.end()));
    for (WalkBounds bounds; found && !isWanted(*found);) {
        found = bounds.look() ? step(*found) : std::nullopt;
    }
    if (found) {
        showPacket(*found);
        return;
    }
    const QString whose = isOfOne ? tr(" of %1").arg(characterName(m_view, *selected)) : QString();
    say(isForward ? tr("No problem%1 after this packet.").arg(whose)
                  : tr("No problem%1 before this packet.").arg(whose));
}

void PacketsPanel::goToSameStream(Direction direction) {
    const bool isForward = direction == Direction::Forward;
    const auto from = m_view.choices().selection.packet;
    const std::uint64_t number = from.value_or(m_view.end() - 1);
    const auto packet = m_view.packet(number);
    const model::PacketDigest* wanted = m_view.accounts().digests().find(number);
    if (!packet || wanted == nullptr) {
        say(tr("No packet is selected."));
        return;
    }
    const auto mayBe = [&](std::uint64_t other) {
        const model::PacketDigest* candidate = m_view.accounts().digests().find(other);
        return other != number && candidate != nullptr && candidate->type == wanted->type &&
               candidate->character == wanted->character;
    };
    WalkBounds bounds;
    const int rows = m_packets.rowCount();
    int row = isForward ? (from ? m_packets.rowFrom(number + 1) : 0)
                        : (from ? m_packets.rowFrom(number) : rows) - 1;
    for (; row >= 0 && row < rows; row += isForward ? 1 : -1) {
        const std::uint64_t other = m_packets.packetAt(row);
        const bool isAlike = mayBe(other);
        if (!bounds.look() || (isAlike && !bounds.read())) {
            say(isForward ? tr("No later packet of this stream is near this one.")
                          : tr("No earlier packet of this stream is near this one."));
            return;
        }
        const auto found = isAlike ? m_view.packet(other) : std::nullopt;
        if (found && found->sender == packet->sender) {
            showPacket(other);
            return;
        }
    }
    say(isForward ? tr("No later packet of this stream.") : tr("No earlier packet of this stream."));
}

void PacketsPanel::goToMark(Direction direction) {
    const bool isForward = direction == Direction::Forward;
    std::vector<std::uint64_t> listed;
    std::ranges::copy_if(m_view.choices().annotations.marks, std::back_inserter(listed),
                         [&](std::uint64_t number) { return m_packets.rowOf(number) >= 0; });
    const auto selected = m_view.choices().selection.packet;
    const std::uint64_t from = selected.value_or(isForward ? 0 : m_view.end());
    const auto after = selected && isForward ? std::ranges::upper_bound(listed, from)
                                             : std::ranges::lower_bound(listed, from);
    if (isForward ? after == listed.end() : after == listed.begin()) {
        say(isForward ? tr("No mark after this packet.") : tr("No mark before this packet."));
        return;
    }
    showPacket(isForward ? *after : *(after - 1));
}

void PacketsPanel::search(Direction direction) {
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
    PacketSearch::Request request{*std::move(pattern),
                                  m_view.choices().selection.packet.value_or(m_view.end()),
                                  direction == Direction::Forward,
                                  {}};
    if (m_packets.isFiltered()) {
        request.among = m_packets.matches();
        if (request.among.empty()) {
            m_find->say(tr("No packet is listed"), true);
            return;
        }
    }
    m_search = std::make_unique<PacketSearch>(m_view.log(), std::move(request));
    m_find->say(tr("Searching …"), false);
    m_poll.start();
}

void PacketsPanel::takeFound() {
    const auto result = m_search ? m_search->result() : std::nullopt;
    if (!result) {
        return;
    }
    m_poll.stop();
    m_search.reset();
    if (!result->packet) {
        m_find->say(result->gone == 0 ? tr("Not found")
                                      : tr("Not found; %1 packets left memory before they were looked at")
                                            .arg(grouped(result->gone)),
                    true);
        return;
    }
    showPacket(*result->packet);
    model::Selection selection = m_view.choices().selection;
    selection.found = {*result->packet, static_cast<std::uint32_t>(result->offset),
                       static_cast<std::uint32_t>(result->offset + result->size)};
    m_commands.select(selection);
    const QString place = tr("in packet %1, byte %2").arg(grouped(*result->packet)).arg(result->offset);
    m_find->say(result->isWrapped ? tr("%1 (wrapped around)").arg(place) : place, false);
}

std::vector<std::uint64_t> PacketsPanel::selectedPackets() const {
    std::vector<std::uint64_t> numbers;
    for (const int row : m_list->selectedRows(kMostCopied)) {
        numbers.push_back(m_packets.packetAt(row));
    }
    if (const auto packet = m_view.choices().selection.packet; numbers.empty() && packet) {
        numbers.push_back(*packet);
    }
    return numbers;
}

void PacketsPanel::copyRows(RowFormat format) {
    const std::vector<int> rows = m_list->selectedRows(kMostCopied);
    const bool isCsv = format == RowFormat::Csv;
    copyText(isCsv ? packetRowsCsv(m_packets, rows) : packetRowsText(m_packets, rows));
    const QString said = isCsv ? tr("Rows copied as CSV: %1") : tr("Rows copied: %1");
    say(rows.empty() ? tr("No packet is selected.") : said.arg(grouped(rows.size())));
}

void PacketsPanel::copyCell() {
    const QModelIndex cell = m_list->currentIndex();
    if (!cell.isValid()) {
        say(tr("No packet is selected."));
        return;
    }
    copyText(cell.data(Qt::DisplayRole).toString());
    say(tr("Cell copied"));
}

void PacketsPanel::copyBytes(ByteFormat format) {
    QString text;
    const std::vector<std::uint64_t> packets = selectedPackets();
    for (const std::uint64_t number : packets) {
        const bool isSpaced = format != ByteFormat::Json && !text.isEmpty();
        text += (isSpaced ? QStringLiteral("\n") : QString()) + packetBytesText(m_view, number, format);
    }
    copyText(text);
    say(packets.empty() ? tr("No packet is selected.")
                        : tr("Packets copied: %1").arg(grouped(packets.size())));
}

std::vector<std::uint64_t> PacketsPanel::meantPackets() const {
    std::vector<std::uint64_t> packets = selectedPackets();
    if (packets.empty() && m_view.end() != m_view.begin()) {
        packets.push_back(newestVisiblePacket(m_view));
    }
    return packets;
}

bool PacketsPanel::areMarked() const {
    const auto packets = meantPackets();
    const auto& marks = m_view.choices().annotations.marks;
    return !packets.empty() &&
           std::ranges::all_of(packets, [&](std::uint64_t number) { return marks.contains(number); });
}

void PacketsPanel::toggleMark() {
    const auto packets = meantPackets();
    if (packets.empty()) {
        say(tr("No packet is selected."));
        return;
    }
    const bool isMarked = !areMarked();
    for (const std::uint64_t number : packets) {
        m_commands.setMarked(number, isMarked);
    }
    if (selectedPackets().empty()) {
        const QString number = grouped(packets.front());
        say(isMarked ? tr("Packet %1 is marked.").arg(number)
                     : tr("Packet %1 is not marked any more.").arg(number));
    }
    refresh();
}

void PacketsPanel::editComment() {
    const std::vector<std::uint64_t> meant = meantPackets();
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
