// SPDX-License-Identifier: GPL-3.0-or-later
// What the menus do with a comparison.
#include "app/gui/base/saving.h"
#include "app/gui/panels/compare_panel.h"

namespace posewire::gui {

namespace {

using CompareDo = ActionsOf<ComparePanel>;
using exporting::AlignBy;
using model::DifferenceFrame;
using By = ComparePanel::By;

constexpr const char* kFile = "&File";
constexpr const char* kCompare = QT_TRANSLATE_NOOP("Action", "&Time/&Comparison");

template <int choice>
constexpr By kBy = choice < 0 ? By() : By(static_cast<AlignBy>(choice));

template <int choice>
void alignBy(ComparePanel& panel) {
    panel.alignBy(kBy<choice>);
}
template <int choice>
bool isAlignedBy(const ComparePanel& panel) {
    return panel.alignedBy() == kBy<choice>;
}

template <int choice>
constexpr ActionInfo alignment(const char* id, const char* text) {
    return {id, kCompare, text, "", CompareDo::call<alignBy<choice>>, CompareDo::is<isAlignedBy<choice>>};
}

template <DifferenceFrame frame>
constexpr ActionInfo overlay(const char* id, const char* text) {
    return {id,
            kCompare,
            text,
            "",
            CompareDo::call<&ComparePanel::setFrame, frame>,
            CompareDo::is<&ComparePanel::frame, frame>};
}

constexpr ActionInfo kCompareActions[] = {
    {"saveDifferences", kFile, QT_TRANSLATE_NOOP("Action", "Save di&fferences…"), "",
     CompareDo::call<&ComparePanel::save>},
    alignment<-1>("alignAutomatically", QT_TRANSLATE_NOOP("Action", "Align auto&matically")),
    alignment<0>("alignByTimeCode", QT_TRANSLATE_NOOP("Action", "Align by &time code")),
    alignment<1>("alignBySample", QT_TRANSLATE_NOOP("Action", "Align by &sample counter")),
    alignment<2>("alignByBegin", QT_TRANSLATE_NOOP("Action", "Align the &beginnings")),
    lineIn(kCompare),
    {"nudgeEarlier", kCompare, QT_TRANSLATE_NOOP("Action", "Second one a sample &earlier"), "[",
     CompareDo::call<&ComparePanel::nudge, -1>},
    {"nudgeLater", kCompare, QT_TRANSLATE_NOOP("Action", "Second one a sample &later"), "]",
     CompareDo::call<&ComparePanel::nudge, 1>},
    {"nudgeNone", kCompare, QT_TRANSLATE_NOOP("Action", "Wit&hout offset"), "",
     CompareDo::call<&ComparePanel::clearOffset>},
    lineIn(kCompare),
    overlay<DifferenceFrame::World>("compareAsSent", QT_TRANSLATE_NOOP("Action", "Compare &as sent")),
    overlay<DifferenceFrame::Heading>("compareOnTheSpot",
                                      QT_TRANSLATE_NOOP("Action", "Compare &on the spot")),
    overlay<DifferenceFrame::Pelvis>("compareWithoutPelvis",
                                     QT_TRANSLATE_NOOP("Action", "Compare without the &pelvis")),
    {"compareBeside", kCompare, QT_TRANSLATE_NOOP("Action", "&Draw it beside"), "",
     CompareDo::call<&ComparePanel::toggleBeside>, CompareDo::is<&ComparePanel::isBeside>},
    lineIn(kCompare),
    {"compareAgain", kCompare, QT_TRANSLATE_NOOP("Action", "&Work out the range again"), "",
     CompareDo::call<&ComparePanel::workAgain>},
    {"compareStop", kCompare, QT_TRANSLATE_NOOP("Action", "Stop wor&king it out"), "",
     CompareDo::call<&ComparePanel::stopWork>},
};

} // namespace

std::span<const ActionInfo> ComparePanel::actionTable() {
    return kCompareActions;
}

void ComparePanel::save() {
    const auto& range = comparison().range;
    if (range == nullptr || range->segments.empty()) {
        m_comparing.save({}); // says why not
        return;
    }
    const QString path = askWhereToSave(this, tr("Save differences"), QStringLiteral("differences.csv"),
                                        tr("Comma-separated values (*.csv)"));
    if (!path.isEmpty()) {
        m_comparing.save(path);
    }
}

} // namespace posewire::gui
