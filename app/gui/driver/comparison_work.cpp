// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/comparison_work.h"

#include <utility>

namespace posewire::gui {
namespace {

using Table = std::shared_ptr<const exporting::Timetable>;

/// The one that is known, else a new one; null where it was cancelled.
Table tableOf(const Table& known, const feed::PoseSource& source, const exporting::ExportProgress& progress) {
    if (known != nullptr) {
        return known;
    }
    auto table = exporting::Timetable::of(source, progress);
    return table ? std::make_shared<const exporting::Timetable>(std::move(*table)) : nullptr;
}

} // namespace

ComparisonWork::ComparisonWork(ComparisonOrder order) : m_shared(std::make_shared<Shared>()) {
    m_shared->order = std::move(order);
    m_outcome = std::async(std::launch::async, [shared = m_shared] { return run(*shared); });
}

ComparisonWork::~ComparisonWork() {
    cancel();
}

ComparisonOutcome ComparisonWork::run(Shared& shared) {
    const ComparisonOrder& order = shared.order;
    int part = 0;
    const int parts = (order.firstTable == nullptr ? 1 : 0) + (order.secondTable == nullptr ? 1 : 0) + 1;
    const exporting::ExportProgress progress = [&](double share) {
        shared.share = (part + share) / parts;
        return !shared.isCancelled;
    };
    ComparisonOutcome outcome;
    const Table second = tableOf(order.secondTable, order.second, progress);
    part += order.secondTable == nullptr ? 1 : 0;
    const Table first = second != nullptr ? tableOf(order.firstTable, order.first, progress) : nullptr;
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
    if (auto compared = exporting::compareMotion(task, progress)) {
        outcome.comparison = std::make_shared<const exporting::MotionComparison>(std::move(*compared));
    }
    return outcome;
}

ComparisonSaving::ComparisonSaving(ComparisonOrder order, std::vector<exporting::SegmentFigures> segments,
                                   std::string path, log::OutputRules rules) {
    m_result = std::async(std::launch::async, [order = std::move(order), segments = std::move(segments),
                                               path = std::move(path), rules = std::move(rules),
                                               isCancelled = m_isCancelled] {
        const exporting::Partners partners(order.firstTable, order.secondTable,
                                           {order.by.value_or(exporting::AlignBy::Begin), order.offset});
        const exporting::ComparisonTask task{order.firstRange, order.second, partners, order.frame};
        const auto written =
            exporting::writeComparisonCsv(task, segments, path, rules, [&](double) { return !*isCancelled; });
        return written ? std::string() : written.error().text;
    });
}

ComparisonSaving::~ComparisonSaving() {
    *m_isCancelled = true;
}

} // namespace posewire::gui
