// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/comparison/alignment.h"
#include "core/model/body/pose_difference.h"

#include <array>
#include <functional>
#include <vector>

/// The same character in two recordings, sample by sample. Memory does not grow with the range.
namespace posewire::exporting {

/// One character of each; all outlive the work.
struct ComparisonTask {
    const feed::PoseSource& first; ///< of the range that is compared
    const feed::PoseSource& second;
    const Partners& partners; ///< of the timetables of both, in full
    model::DifferenceFrame frame = model::DifferenceFrame::World;
};

/// A sample of the first recording with its partner.
struct ComparedPair {
    const model::CharacterPose* first = nullptr;
    const model::CharacterPose* second = nullptr;      ///< null where it has none
    const model::PoseDifference* difference = nullptr; ///< null without a partner, or a segment in common
};

/// Hands out every sample of the first recording in the order of the counters. A pair is valid during the
/// call. Returns how many packets of its range the log of the first had dropped before they were read. Fails
/// as cancelled only.
[[nodiscard]] tl::expected<std::uint64_t, log::FileError>
walkPairs(const ComparisonTask& task, const std::function<void(const ComparedPair&)>& visit,
          const ExportProgress& progress);

/// Of one segment or of all, over a range: mm or degrees.
struct DifferenceFigures {
    double mean = 0;
    double median = 0;
    double p95 = 0;
    double most = 0;
    log::Stamp mostAt{}; ///< of the sample of the first recording
};

struct SegmentFigures {
    int slot = 0; ///< see model::kAllSegments
    std::uint64_t pairs = 0;
    DifferenceFigures millimetres;
    DifferenceFigures degrees;
};

/// How differences go over a range, in parts of the same length.
struct DifferenceCourse {
    static constexpr std::size_t kParts = 1200;
    log::Stamp begin{};     ///< of the first sample
    log::Duration length{}; ///< of one part
    /// The largest in each part, by slot; NaN where nothing was compared. No parts of a segment that not
    /// both have. Behind those of the slots: the mean over all segments.
    std::array<std::vector<float>, model::kMaxSegmentCount + 1> millimetres;
    std::array<std::vector<float>, model::kMaxSegmentCount + 1> degrees;
    static constexpr std::size_t kMean = model::kMaxSegmentCount;
};

struct MotionComparison {
    std::uint64_t pairs = 0;      ///< that were compared
    std::uint64_t alone = 0;      ///< samples of the first without a partner, in the time that both have
    std::uint64_t outside = 0;    ///< samples of the first before or after all of the second
    std::uint64_t apart = 0;      ///< pairs without a segment in common
    std::uint64_t passedOver = 0; ///< packets of the range that were dropped before they were looked at
    log::Stamp first{};           ///< of the samples of the first recording that were looked at
    log::Stamp last{};
    std::vector<SegmentFigures> segments; ///< that both have
    SegmentFigures all;                   ///< every segment of every pair; its slot means nothing
    DifferenceCourse course;

    /// Of the segment with the largest mean by mm; null where nothing was compared.
    [[nodiscard]] const SegmentFigures* worst() const;
};

/// Fails as cancelled only.
[[nodiscard]] tl::expected<MotionComparison, log::FileError> compareMotion(const ComparisonTask& task,
                                                                           const ExportProgress& progress);

} // namespace posewire::exporting
