// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/export/comparison/pose_comparison.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace posewire::gui {

/// What a thread compares, by value but for the logs, which outlive it.
struct ComparisonOrder {
    feed::PoseSource first;      ///< all of it
    feed::PoseSource firstRange; ///< what is compared of it
    feed::PoseSource second;
    /// As far as they are known from before; null if they are to be made.
    std::shared_ptr<const exporting::Timetable> firstTable;
    std::shared_ptr<const exporting::Timetable> secondTable;
    std::optional<exporting::AlignBy> by;
    double offset = 0;
    model::DifferenceFrame frame = model::DifferenceFrame::World;
};

struct ComparisonOutcome {
    std::shared_ptr<const exporting::Timetable> firstTable; ///< null if it was cancelled
    std::shared_ptr<const exporting::Timetable> secondTable;
    std::shared_ptr<const exporting::Partners> partners;
    std::shared_ptr<const exporting::MotionComparison> comparison;
};

/// Compares a range.
[[nodiscard]] ComparisonOutcome compared(const ComparisonOrder& order,
                                         const exporting::ExportProgress& progress);

/// Writes the differences of a range to a file. Returns what went wrong, empty for nothing.
[[nodiscard]] std::string writeDifferences(const ComparisonOrder& order,
                                           const std::vector<exporting::SegmentFigures>& segments,
                                           const std::string& path,
                                           const exporting::ExportProgress& progress);

} // namespace posewire::gui
