// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/comparison/alignment.h"
#include "core/log/output_file.h"
#include "core/model/body/pose_difference.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// The same character in two recordings, sample by sample. Memory does not grow with the range.
namespace posewire::exporting {

/// How values of 0 and more are spread, however many there are, in a memory that does not grow: mean and most
/// are exact, quantiles within 0.3 %.
class Spread {
public:
    void add(double value);

    [[nodiscard]] std::uint64_t count() const { return m_count; }
    [[nodiscard]] double mean() const { return m_count == 0 ? 0 : m_sum / static_cast<double>(m_count); }
    [[nodiscard]] double most() const { return m_most; }
    /// Below which a share of the values lie, from 0 to 1; 0 without any.
    [[nodiscard]] double quantile(double share) const;

private:
    std::uint64_t m_count = 0;
    double m_sum = 0;
    double m_least = 0;
    double m_most = 0;
    std::vector<std::uint32_t> m_bins; ///< each wider than the one before by the same factor
};

/// One character of each; all outlive the work.
struct ComparisonTask {
    const feed::PoseSource& first; ///< of the range that is compared
    const feed::PoseSource& second;
    const Partners& partners; ///< of the timetables of both, in full
    model::DifferenceFrame frame = model::DifferenceFrame::World;
};

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

/// Writes a table (RFC 4180, UTF-8, lines end with CR LF) with a row for each sample of the first recording
/// and the columns
///
///     time,sample,timeCode,otherSample,otherTimeCode,Pelvis mm,Pelvis degrees,L5 mm,…
///
/// time is seconds since the first row; counters and time codes (ms) are as sent. Cells of what has no
/// partner are empty. The file is there whole or not at all.
[[nodiscard]] tl::expected<void, log::FileError>
writeComparisonCsv(const ComparisonTask& task, std::span<const SegmentFigures> segments,
                   const std::string& path, const log::OutputRules& rules, const ExportProgress& progress);

} // namespace posewire::exporting
