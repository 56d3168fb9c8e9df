// SPDX-License-Identifier: GPL-3.0-or-later
// What the menus do in the list of packets.
#include "app/gui/panels/filter_bar.h"
#include "app/gui/panels/find_bar.h"
#include "app/gui/panels/packets_panel.h"

#include <QMenu>

namespace posewire::gui {

namespace {

constexpr const char* kEdit = QT_TRANSLATE_NOOP("Action", "&Edit");
constexpr const char* kCopy = QT_TRANSLATE_NOOP("Action", "&Edit/Co&py packets");
constexpr const char* kCell = QT_TRANSLATE_NOOP("Action", "&Edit/&Apply cell as filter");
constexpr const char* kTimes = QT_TRANSLATE_NOOP("Action", "&View/&Packet times");
constexpr const char* kGo = QT_TRANSLATE_NOOP("Action", "&Go");

} // namespace

/// A part of the panel, so that its entries reach what is private there.
struct PacketsPanel::Actions {
    using Do = ActionsOf<PacketsPanel>;
    using Selected = SelectedPackets;
    using Navigation = PacketNavigation;
    using Time = PacketModel::TimeMode;
    using Delta = PacketModel::DeltaMode;
    template <auto function, auto... arguments>
    static constexpr auto onSelected = Do::callIn<&PacketsPanel::m_selected, function, arguments...>;
    template <auto function, auto... arguments>
    static constexpr auto navigate = Do::callIn<&PacketsPanel::m_navigation, function, arguments...>;
    static constexpr auto kForward = Direction::Forward;
    static constexpr auto kBackward = Direction::Backward;

    static constexpr ActionInfo kTable[] = {
        {"mark", kEdit, QT_TRANSLATE_NOOP("Action", "&Mark packet"), "Ctrl+M",
         onSelected<&Selected::toggleMark>},
        {"comment", kEdit, QT_TRANSLATE_NOOP("Action", "&Comment on packet…"), "Ctrl+Alt+C",
         onSelected<&Selected::editComment>},
        lineIn(kEdit),
        {"copyRows", kCopy, QT_TRANSLATE_NOOP("Action", "&Rows as text"), "",
         onSelected<&Selected::copyRows, Selected::RowFormat::Text>},
        {"copyCsv", kCopy, QT_TRANSLATE_NOOP("Action", "Rows as C&SV"), "",
         onSelected<&Selected::copyRows, Selected::RowFormat::Csv>},
        {"copyCell", kCopy, QT_TRANSLATE_NOOP("Action", "Ce&ll"), "", onSelected<&Selected::copyCell>},
        lineIn(kCopy),
        {"copyBytesText", kCopy, QT_TRANSLATE_NOOP("Action", "Bytes as &hexadecimal text"), "Ctrl+Shift+C",
         onSelected<&Selected::copyBytes, ByteFormat::Text>},
        {"copyBytesRaw", kCopy, QT_TRANSLATE_NOOP("Action", "Bytes as ra&w hexadecimal"), "",
         onSelected<&Selected::copyBytes, ByteFormat::Raw>},
        {"copyBytesCArray", kCopy, QT_TRANSLATE_NOOP("Action", "Bytes as C &array"), "",
         onSelected<&Selected::copyBytes, ByteFormat::CArray>},
        {"copyBytesJson", kCopy, QT_TRANSLATE_NOOP("Action", "Packets as &JSON"), "",
         onSelected<&Selected::copyBytes, ByteFormat::Json>},
        lineIn(kEdit),
        {"filter", kEdit, QT_TRANSLATE_NOOP("Action", "&Filter packets"), "Ctrl+L",
         Do::callIn<&PacketsPanel::m_filter, &FilterBar::focusLine>},
        {"filterByCell", kCell, QT_TRANSLATE_NOOP("Action", "&Only this"), "Ctrl+Shift+L",
         onSelected<&Selected::applyCell, FilterJoin::Replace>},
        {"filterAndCell", kCell, QT_TRANSLATE_NOOP("Action", "… &and"), "",
         onSelected<&Selected::applyCell, FilterJoin::And>},
        {"filterOrCell", kCell, QT_TRANSLATE_NOOP("Action", "… o&r"), "",
         onSelected<&Selected::applyCell, FilterJoin::Or>},
        {"filterNotCell", kCell, QT_TRANSLATE_NOOP("Action", "… and &not"), "",
         onSelected<&Selected::applyCell, FilterJoin::AndNot>},
        lineIn(kEdit),
        {"find", kEdit, QT_TRANSLATE_NOOP("Action", "Find &bytes or text…"), "Ctrl+F",
         Do::callIn<&PacketsPanel::m_find, &FindBar::open>},
        {"findNext", kEdit, QT_TRANSLATE_NOOP("Action", "Find ne&xt"), "F3",
         navigate<&Navigation::find, kForward>},
        {"findPrevious", kEdit, QT_TRANSLATE_NOOP("Action", "Find pre&vious"), "Shift+F3",
         navigate<&Navigation::find, kBackward>},

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
         navigate<&Navigation::askForPacket>},
        lineIn(kGo),
        {"nextProblem", kGo, QT_TRANSLATE_NOOP("Action", "&Next problem"), "N",
         navigate<&Navigation::goToProblem, kForward>},
        {"previousProblem", kGo, QT_TRANSLATE_NOOP("Action", "&Previous problem"), "Shift+N",
         navigate<&Navigation::goToProblem, kBackward>},
        lineIn(kGo),
        {"nextOfStream", kGo, QT_TRANSLATE_NOOP("Action", "Next packet of the &stream"), "Ctrl+.",
         navigate<&Navigation::goToSameStream, kForward>},
        {"previousOfStream", kGo, QT_TRANSLATE_NOOP("Action", "Previous packet of the s&tream"), "Ctrl+,",
         navigate<&Navigation::goToSameStream, kBackward>},
        lineIn(kGo),
        {"nextMark", kGo, QT_TRANSLATE_NOOP("Action", "Next &mark"), "Ctrl+Shift+N",
         navigate<&Navigation::goToMark, kForward>},
        {"previousMark", kGo, QT_TRANSLATE_NOOP("Action", "Previous m&ark"), "Ctrl+Shift+B",
         navigate<&Navigation::goToMark, kBackward>},
        lineIn(kGo),
        {"firstPacket", kGo, QT_TRANSLATE_NOOP("Action", "&First packet"), "Ctrl+Home",
         navigate<&Navigation::goToFirst>},
        {"newestPacket", kGo, QT_TRANSLATE_NOOP("Action", "Ne&west packet, and follow"), "Ctrl+End",
         navigate<&Navigation::goToNewest>},
    };
};

std::span<const ActionInfo> PacketsPanel::actionTable() {
    return Actions::kTable;
}

/// Filters by the current cell, and what the window's menus do with the selected packets.
void PacketsPanel::showMenu(const QPoint& globalPlace) {
    QMenu menu(this);
    const QString condition = m_selected.cellFilter();
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
        menu.addAction(text, this, [this, join = join] { m_selected.applyCell(join); })
            ->setEnabled(!condition.isEmpty());
    }
    menu.addSeparator();
    QMenu* copy = menu.addMenu(tr("&Copy"));
    addEntries(*copy, actionTable(), kCopy, *this);
    const auto add = [&](const QString& text, auto carryOut) {
        menu.addAction(text, this, carryOut)->setEnabled(!m_selected.isEmpty());
    };
    copy->setEnabled(!m_selected.isEmpty());
    add(tr("&Mark"), [this] { m_selected.toggleMark(); });
    add(tr("C&omment…"), [this] { m_selected.editComment(); });
    menu.addSeparator();
    add(tr("&Next of this stream"), [this] { m_navigation.goToSameStream(Direction::Forward); });
    add(tr("&Previous of this stream"), [this] { m_navigation.goToSameStream(Direction::Backward); });
    addEntries(*menu.addMenu(tr("&Times")), actionTable(), kTimes, *this);
    menu.exec(globalPlace);
}

} // namespace posewire::gui
