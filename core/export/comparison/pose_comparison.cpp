// SPDX-License-Identifier: MIT
#include "core/export/comparison/pose_comparison.h"

#include "core/export/motion/motion_writer.h"
#include "core/export/sheets.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <memory>
#include <optional>

namespace posewire::exporting {
namespace {

constexpr std::size_t kSlots = model::kMaxSegmentCount;

struct ComparedPair {
    const model::CharacterPose* first = nullptr;
    const model::CharacterPose* second = nullptr;      ///< null where it has none
    const model::PoseDifference* difference = nullptr; ///< null without a partner, or a segment in common
};

/// Values of one kind, with when the largest was.
struct Sums {
    Spread spread;
    log::Stamp mostAt{};

    void add(double value, log::Stamp at) {
        if (spread.count() == 0 || value > spread.most()) {
            mostAt = at;
        }
        spread.add(value);
    }
    [[nodiscard]] DifferenceFigures figures() const {
        return {spread.mean(), spread.quantile(0.5), spread.quantile(0.95), spread.most(), mostAt};
    }
};

struct SegmentSums {
    Sums millimetres;
    Sums degrees;

    void add(double distance, double turn, log::Stamp at) {
        millimetres.add(distance, at);
        degrees.add(turn, at);
    }
    [[nodiscard]] SegmentFigures figures(int slot) const {
        return {slot, millimetres.spread.count(), millimetres.figures(), degrees.figures()};
    }
};

/// The time that the samples of a source take.
void setTime(const ComparisonTask& task, DifferenceCourse& course) {
    const std::vector<SampleMoment>& samples = task.partners.first().samples();
    const auto isIn = [&](const SampleMoment& one) {
        return one.packet >= task.first.firstPacket && one.packet < task.first.endPacket;
    };
    const auto first = std::ranges::find_if(samples, isIn);
    const auto last = std::find_if(samples.rbegin(), samples.rend(), isIn);
    if (first == samples.end()) {
        return;
    }
    // Parts of two samples at least: none is empty only because samples come when they come.
    const double period = std::max(task.partners.first().periodMs(), task.partners.second().periodMs());
    const double all = log::millisecondsOf(last->stamp - first->stamp);
    const double length = std::max({all / (DifferenceCourse::kParts - 1), 2 * period, 1.0});
    course.begin = first->stamp;
    course.length = log::durationOf(length / 1000);
    const auto parts = std::min(static_cast<std::size_t>(all / length) + 1, DifferenceCourse::kParts);
    course.millimetres[DifferenceCourse::kMean].resize(parts, std::numeric_limits<float>::quiet_NaN());
    course.degrees[DifferenceCourse::kMean].resize(parts, std::numeric_limits<float>::quiet_NaN());
}

void raise(std::vector<float>& parts, std::size_t part, std::size_t all, double value) {
    if (parts.empty()) {
        parts.resize(all, std::numeric_limits<float>::quiet_NaN());
    }
    float& most = parts[std::min(part, all - 1)];
    most = std::isnan(most) ? static_cast<float>(value) : std::max(most, static_cast<float>(value));
}

void addTo(DifferenceCourse& course, log::Stamp at, const model::PoseDifference& difference) {
    const std::size_t parts = course.millimetres[DifferenceCourse::kMean].size();
    if (parts == 0) {
        return;
    }
    const auto part = static_cast<std::size_t>(std::max(at - course.begin, log::Duration{}) / course.length);
    for (const model::SegmentDifference& one : difference.segments) {
        const auto slot = static_cast<std::size_t>(one.slot);
        raise(course.millimetres[slot], part, parts, one.millimetres);
        raise(course.degrees[slot], part, parts, one.degrees);
    }
    raise(course.millimetres[DifferenceCourse::kMean], part, parts, difference.meanMillimetres());
    raise(course.degrees[DifferenceCourse::kMean], part, parts, difference.meanDegrees());
}

class Comparing {
public:
    explicit Comparing(const ComparisonTask& task) : m_task(task) { setTime(task, m_result.course); }

    void add(const ComparedPair& pair) {
        const log::Stamp at = pair.first->stamp;
        m_result.first = m_isFirst ? at : m_result.first;
        m_result.last = std::max(m_result.last, at);
        m_isFirst = false;
        if (pair.second == nullptr) {
            ++(m_task.partners.isCommon(momentOf(*pair.first)) ? m_result.alone : m_result.outside);
        } else if (pair.difference == nullptr) {
            ++m_result.apart;
        } else {
            addCompared(at, *pair.difference);
        }
    }

    [[nodiscard]] MotionComparison conclude() {
        for (std::size_t slot = 0; slot < kSlots; ++slot) {
            if (m_sums[slot].millimetres.spread.count() != 0) {
                m_result.segments.push_back(m_sums[slot].figures(static_cast<int>(slot)));
            }
        }
        m_result.all = m_all.figures(-1);
        return std::move(m_result);
    }

private:
    void addCompared(log::Stamp at, const model::PoseDifference& difference) {
        ++m_result.pairs;
        for (const model::SegmentDifference& one : difference.segments) {
            m_sums[static_cast<std::size_t>(one.slot)].add(one.millimetres, one.degrees, at);
            m_all.add(one.millimetres, one.degrees, at);
        }
        addTo(m_result.course, at, difference);
    }

    const ComparisonTask& m_task;
    MotionComparison m_result;
    std::array<SegmentSums, kSlots> m_sums;
    SegmentSums m_all;
    bool m_isFirst = true;
};

/// The samples of the second recording by their place in its timetable. They are read once in their order;
/// where the first recording goes back, further than what is kept, from the beginning again.
class SecondSamples {
public:
    explicit SecondSamples(const feed::PoseSource& source) : m_source(source) { restart(); }

    /// Null if it cannot be read any more. Valid until the next call.
    const model::CharacterPose* at(std::size_t place) {
        if (place < m_first) {
            if (m_restarts++ == kMostRestarts) {
                return nullptr;
            }
            restart();
        }
        while (place >= m_first + m_kept.size()) {
            forget(place);
            if (!m_poses->advance(m_keep)) {
                return nullptr;
            }
        }
        forget(place);
        return place < m_first + m_kept.size() ? &m_kept[place - m_first] : nullptr;
    }

private:
    static constexpr std::size_t kBack = 256; ///< samples that are kept behind the one that is asked for
    static constexpr int kMostRestarts = 1000;

    void restart() {
        m_first = 0;
        m_kept.clear();
        m_poses = std::make_unique<feed::PoseFeed>(m_source, feed::PoseContent::Segments);
    }

    void forget(std::size_t place) {
        while (!m_kept.empty() && m_first + kBack < place) {
            m_kept.pop_front();
            ++m_first;
        }
    }

    const feed::PoseSource& m_source;
    std::unique_ptr<feed::PoseFeed> m_poses;
    const feed::TakePose m_keep = [this](const feed::PoseSample& sample) {
        if (sample.character == 0) {
            m_kept.push_back(sample.pose);
        }
    };
    std::deque<model::CharacterPose> m_kept;
    std::size_t m_first = 0; ///< place of the oldest that is kept
    int m_restarts = 0;
};

constexpr double kSmallest = 1e-3; ///< what is less is in the first bin
constexpr double kInDoubling = 128;
constexpr std::size_t kBins = 3600; ///< up to 1e-3 · 2^28

std::size_t binOf(double value) {
    const double place = value <= kSmallest ? 0 : 1 + kInDoubling * std::log2(value / kSmallest);
    return static_cast<std::size_t>(std::min(place, static_cast<double>(kBins - 1)));
}

double middleOf(std::size_t bin) {
    return bin == 0 ? 0 : kSmallest * std::exp2((static_cast<double>(bin) - 0.5) / kInDoubling);
}

std::string decimalCell(double value, int decimals) {
    std::string text;
    appendFixed(value, decimals, text);
    return text;
}

std::vector<std::string> titles(std::span<const SegmentFigures> segments) {
    std::vector<std::string> cells{"time", "sample", "timeCode", "otherSample", "otherTimeCode"};
    for (const SegmentFigures& one : segments) {
        const std::string name(model::segmentName(model::kAllSegments, one.slot));
        cells.push_back(name + " mm");
        cells.push_back(name + " degrees");
    }
    return cells;
}

std::vector<std::string> csvRow(const ComparedPair& pair, std::span<const SegmentFigures> segments,
                                log::Stamp begin) {
    std::vector<std::string> cells{decimalCell(log::secondsOf(pair.first->stamp - begin), 4),
                                   std::to_string(pair.first->sample), std::to_string(pair.first->timeCode)};
    cells.push_back(pair.second != nullptr ? std::to_string(pair.second->sample) : std::string());
    cells.push_back(pair.second != nullptr ? std::to_string(pair.second->timeCode) : std::string());
    for (const SegmentFigures& one : segments) {
        const model::SegmentDifference* difference =
            pair.difference != nullptr ? pair.difference->find(one.slot) : nullptr;
        cells.push_back(difference != nullptr ? decimalCell(difference->millimetres, 2) : std::string());
        cells.push_back(difference != nullptr ? decimalCell(difference->degrees, 3) : std::string());
    }
    return cells;
}

/// Hands out every sample of the first recording in the order of the counters. A pair is valid during the
/// call. Returns how many packets of its range the log of the first had dropped before they were read. Fails
/// as cancelled only.
tl::expected<std::uint64_t, log::FileError> walkPairs(const ComparisonTask& task,
                                                      const std::function<void(const ComparedPair&)>& visit,
                                                      const ExportProgress& progress) {
    SecondSamples second(task.second);
    model::PoseDifference difference;
    return walkMotion(
        task.first, feed::PoseContent::Segments,
        [&](const feed::PoseSample& sample) {
            if (sample.character != 0) {
                return;
            }
            ComparedPair pair{&sample.pose};
            if (const auto partner = task.partners.of(momentOf(sample.pose))) {
                pair.second = second.at(*partner);
            }
            const bool isCompared =
                pair.second != nullptr && differenceOf(sample.pose, *pair.second, task.frame, difference);
            pair.difference = isCompared ? &difference : nullptr;
            visit(pair);
        },
        progress);
}

} // namespace

const SegmentFigures* MotionComparison::worst() const {
    const auto most = std::ranges::max_element(
        segments, {}, [](const SegmentFigures& one) { return one.millimetres.mean; });
    return most == segments.end() ? nullptr : &*most;
}

tl::expected<MotionComparison, log::FileError> compareMotion(const ComparisonTask& task,
                                                             const ExportProgress& progress) {
    Comparing comparing(task);
    const auto add = [&](const ComparedPair& pair) { comparing.add(pair); };
    return walkPairs(task, add, progress).map([&](std::uint64_t passedOver) {
        MotionComparison result = comparing.conclude();
        result.passedOver = passedOver;
        return result;
    });
}

void Spread::add(double value) {
    if (!std::isfinite(value)) {
        return;
    }
    if (m_bins.empty()) {
        m_bins.resize(kBins);
    }
    m_least = m_count == 0 ? value : std::min(m_least, value);
    m_most = m_count == 0 ? value : std::max(m_most, value);
    ++m_count;
    m_sum += value;
    ++m_bins[binOf(value)];
}

double Spread::quantile(double share) const {
    const auto wanted = static_cast<std::uint64_t>(share * static_cast<double>(m_count));
    std::uint64_t below = 0;
    for (std::size_t bin = 0; bin < m_bins.size(); ++bin) {
        below += m_bins[bin];
        if (below > wanted || (below == m_count && below != 0)) {
            return std::clamp(middleOf(bin), m_least, m_most);
        }
    }
    return 0;
}

tl::expected<void, log::FileError> writeComparisonCsv(const ComparisonTask& task,
                                                      std::span<const SegmentFigures> segments,
                                                      const std::string& path, const log::OutputRules& rules,
                                                      const ExportProgress& progress) {
    auto sink = log::createWholeFile(path, rules);
    if (!sink) {
        return tl::unexpected(sink.error());
    }
    MotionOutput out(std::move(*sink));
    out.write(csvLine(titles(segments)));
    std::optional<log::Stamp> begin;
    const auto walked = walkPairs(
        task,
        [&](const ComparedPair& pair) {
            begin = begin.value_or(pair.first->stamp);
            out.write(csvLine(csvRow(pair, segments, *begin)));
        },
        [&](double share) { return !out.hasFailed() && (!progress || progress(share)); });
    if (!walked && !out.hasFailed()) {
        return tl::unexpected(walked.error());
    }
    if (walked && *walked != 0) {
        out.fail(path + ": the log dropped part of the range while it was written; choose a later beginning");
    }
    return out.finish();
}

} // namespace posewire::exporting
