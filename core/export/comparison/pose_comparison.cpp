// SPDX-License-Identifier: MIT
#include "core/export/comparison/pose_comparison.h"

#include "core/export/comparison/spread.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace posewire::exporting {
namespace {

constexpr std::size_t kSlots = model::kMaxSegmentCount;

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

/// What comes of the pairs of a range.
class Comparing {
public:
    explicit Comparing(const ComparisonTask& task) : m_task(task) { setTime(task, m_result.course); }

    void add(const ComparedPair& pair) {
        const log::Stamp at = pair.first->stamp;
        m_result.first = m_isFirst ? at : m_result.first;
        m_result.last = std::max(m_result.last, at);
        m_isFirst = false;
        if (pair.second == nullptr) {
            const SampleMoment moment{pair.first->sample, pair.first->timeCode, at, pair.first->packet};
            ++(m_task.partners.isCommon(moment) ? m_result.alone : m_result.outside);
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

} // namespace

const SegmentFigures* MotionComparison::worst() const {
    const auto most = std::ranges::max_element(
        segments, {}, [](const SegmentFigures& one) { return one.millimetres.mean; });
    return most == segments.end() ? nullptr : &*most;
}

tl::expected<MotionComparison, log::FileError> compareMotion(const ComparisonTask& task,
                                                             const ExportProgress& progress) {
    Comparing comparing(task);
    const auto walked = walkPairs(
        task, [&](const ComparedPair& pair) { comparing.add(pair); }, progress);
    if (!walked) {
        return tl::unexpected(walked.error());
    }
    MotionComparison result = comparing.conclude();
    result.passedOver = *walked;
    return result;
}

} // namespace posewire::exporting
