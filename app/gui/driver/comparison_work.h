// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/export/comparison/comparison_csv.h"

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <string>

namespace posewire::gui {

/// What a thread compares, by value but for the logs, which outlive it.
struct ComparisonOrder {
    feed::PoseSource first;      ///< all of it
    feed::PoseSource firstRange; ///< what is compared of it
    feed::PoseSource second;
    /// As far as they are known from before; null where they are to be made.
    std::shared_ptr<const exporting::Timetable> firstTable;
    std::shared_ptr<const exporting::Timetable> secondTable;
    std::optional<exporting::AlignBy> by;
    double offset = 0;
    model::DifferenceFrame frame = model::DifferenceFrame::World;
};

struct ComparisonOutcome {
    std::shared_ptr<const exporting::Timetable> firstTable; ///< null where it was cancelled
    std::shared_ptr<const exporting::Timetable> secondTable;
    std::shared_ptr<const exporting::Partners> partners;
    std::shared_ptr<const exporting::MotionComparison> comparison;
};

/// One comparison of a range on a thread of its own.
class ComparisonWork {
public:
    explicit ComparisonWork(ComparisonOrder order);
    /// Waits until nothing reads the logs any more: a few milliseconds.
    ~ComparisonWork();
    ComparisonWork(const ComparisonWork&) = delete;
    ComparisonWork& operator=(const ComparisonWork&) = delete;

    [[nodiscard]] double share() const { return m_shared->share; }
    void cancel() { m_shared->isCancelled = true; }
    [[nodiscard]] bool isDone() const {
        return m_outcome.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    }
    /// Once, when it is done.
    [[nodiscard]] ComparisonOutcome take() { return m_outcome.get(); }

private:
    struct Shared {
        ComparisonOrder order;
        std::atomic<double> share{0};
        std::atomic<bool> isCancelled{false};
    };
    [[nodiscard]] static ComparisonOutcome run(Shared& shared);

    std::shared_ptr<Shared> m_shared;
    std::future<ComparisonOutcome> m_outcome;
};

/// Writes the differences of a range to a file, likewise.
class ComparisonSaving {
public:
    ComparisonSaving(ComparisonOrder order, std::vector<exporting::SegmentFigures> segments, std::string path,
                     log::OutputRules rules);
    ~ComparisonSaving();
    ComparisonSaving(const ComparisonSaving&) = delete;
    ComparisonSaving& operator=(const ComparisonSaving&) = delete;

    [[nodiscard]] bool isDone() const {
        return m_result.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    }
    /// What went wrong, empty for nothing. Once, when it is done.
    [[nodiscard]] std::string take() { return m_result.get(); }

private:
    std::shared_ptr<std::atomic<bool>> m_isCancelled = std::make_shared<std::atomic<bool>>(false);
    std::future<std::string> m_result;
};

} // namespace posewire::gui
