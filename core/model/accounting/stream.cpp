// SPDX-License-Identifier: MIT
#include "core/model/accounting/stream.h"

#include <numeric>

namespace posewire::model {
namespace {

constexpr log::Duration kWindow = std::chrono::seconds(2);
constexpr double kNsPerSecond = 1e9;

} // namespace

void StreamStatistics::addSample(log::Stamp stamp) {
    m_arrivals[m_samples % kMostSamples] = stamp;
    ++m_samples;
}

std::size_t StreamStatistics::windowSize() const {
    const std::size_t kept = std::min<std::uint64_t>(m_samples, kMostSamples);
    std::size_t low = 0;
    std::size_t high = kept;
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        if (arrival(middle) >= m_lastStamp - kWindow) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    // A stream slower than the window still has a rate: that of its last two samples.
    return std::max(low, std::min<std::size_t>(kept, 2));
}

double StreamStatistics::rateHz() const {
    const std::size_t size = windowSize();
    const log::Duration span = size < 2 ? log::Duration::zero() : arrival(0) - arrival(size - 1);
    if (span <= log::Duration::zero()) {
        return 0;
    }
    return kNsPerSecond / (static_cast<double>(span.count()) / static_cast<double>(size - 1));
}

std::array<std::uint64_t, kLossCauses> Stream::lostByCause() const {
    auto result = attributed;
    const StreamCounts counts = accounting.counts();
    const std::uint64_t lost = counts.lost + counts.incomplete;
    std::uint64_t& unknown = result[static_cast<std::size_t>(LossCause::Unknown)];
    unknown = 0;
    const std::uint64_t known = std::accumulate(result.begin(), result.end(), std::uint64_t{0});
    unknown = lost > known ? lost - known : 0;
    return result;
}

void Stream::addSamples(log::Stamp stamp, const wire::Header& header, std::span<const Verdict> verdicts) {
    if (!accounting.isSampled() && header.datagramIndex() == 0) {
        statistics.addSample(stamp);
    }
    for (const Verdict& verdict : verdicts) {
        if (accounting.isSampled() && verdict.isFirstOfSample) {
            statistics.addSample(verdict.stamp);
        }
    }
}

double Stream::rateAt(log::Stamp now) const {
    const double rateHz = statistics.rateHz();
    const double age = log::secondsOf(now - accounting.lastStamp());
    return age > std::max(kStaleAge, patienceAt(rateHz)) ? 0 : rateHz;
}

} // namespace posewire::model
