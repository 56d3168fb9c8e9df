// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/comparison_work.h"

#include "app/gui/base/saving.h"

#include <utility>

namespace posewire::gui {
namespace {

using Table = std::shared_ptr<const exporting::Timetable>;

/// The one that is known, else a new one; null if it was cancelled.
Table tableOf(const Table& known, const feed::PoseSource& source, const exporting::ExportProgress& progress) {
    if (known != nullptr) {
        return known;
    }
    auto table = exporting::Timetable::of(source, progress);
    return table ? std::make_shared<const exporting::Timetable>(std::move(*table)) : nullptr;
}

} // namespace

ComparisonOutcome compared(const ComparisonOrder& order, const exporting::ExportProgress& progress) {
    int part = 0;
    const int parts = (order.firstTable == nullptr ? 1 : 0) + (order.secondTable == nullptr ? 1 : 0) + 1;
    const exporting::ExportProgress ofAll = [&](double share) { return progress((part + share) / parts); };
    ComparisonOutcome outcome;
    const Table second = tableOf(order.secondTable, order.second, ofAll);
    part += order.secondTable == nullptr ? 1 : 0;
    const Table first = second != nullptr ? tableOf(order.firstTable, order.first, ofAll) : nullptr;
    part += order.firstTable == nullptr ? 1 : 0;
    if (first == nullptr) {
        return outcome;
    }
    const exporting::AlignBy by = order.by.value_or(exporting::naturalAlignment(*first, *second));
    outcome.partners =
        std::make_shared<const exporting::Partners>(first, second, exporting::Alignment{by, order.offset});
    const exporting::ComparisonTask task{order.firstRange, order.second, *outcome.partners, order.frame};
    outcome.firstTable = first;
    outcome.secondTable = second;
    if (auto comparison = exporting::compareMotion(task, ofAll)) {
        outcome.comparison = std::make_shared<const exporting::MotionComparison>(std::move(*comparison));
    }
    return outcome;
}

std::string writeDifferences(const ComparisonOrder& order,
                             const std::vector<exporting::SegmentFigures>& segments, const std::string& path,
                             const exporting::ExportProgress& progress) {
    const exporting::Partners partners(order.firstTable, order.secondTable,
                                       {order.by.value_or(exporting::AlignBy::Begin), order.offset});
    const exporting::ComparisonTask task{order.firstRange, order.second, partners, order.frame};
    const auto written = exporting::writeComparisonCsv(task, segments, path, replacing(), progress);
    return written ? std::string() : written.error().text;
}

} // namespace posewire::gui
