// SPDX-License-Identifier: MIT
#include "core/model/accounting/stream_statistics.h"

#include <algorithm>
#include <cmath>

namespace posewire::model {
namespace {

constexpr std::int64_t kWindowNs = 2'000'000'000;
constexpr double kNsPerSecond = 1e9;

} // namespace

void StreamStatistics::add(std::int64_t stampNs, std::size_t bytes, bool beginsSample) {
    m_lastStampNs = stampNs;
    m_bytes += bytes;
    if (beginsSample) {
        m_arrivals[m_samples % kWindow] = {stampNs, m_bytes};
        ++m_samples;
    }
}

std::size_t StreamStatistics::windowSize() const {
    const std::size_t kept = std::min<std::uint64_t>(m_samples, kWindow);
    std::size_t low = 0;
    std::size_t high = kept;
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        if (arrival(middle).stampNs >= m_lastStampNs - kWindowNs) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    // A stream slower than the window still has a rate: that of its last two samples.
    return std::max(low, std::min<std::size_t>(kept, 2));
}

double StreamStatistics::rateHz() const {
    const Spacing between = spacing();
    return between.mean > 0 ? kNsPerSecond / between.mean : 0;
}

double StreamStatistics::bytesPerSecond() const {
    const std::size_t size = windowSize();
    if (size < 2) {
        return 0;
    }
    const Arrival& newest = arrival(0);
    const Arrival& oldest = arrival(size - 1);
    const auto span = static_cast<double>(newest.stampNs - oldest.stampNs);
    return span > 0 ? static_cast<double>(newest.bytesSoFar - oldest.bytesSoFar) * kNsPerSecond / span : 0;
}

StreamStatistics::Spacing StreamStatistics::spacing() const {
    const std::size_t size = windowSize();
    if (size < 2) {
        return {};
    }
    Spacing result;
    result.least = INFINITY;
    double squares = 0;
    for (std::size_t i = 0; i + 1 < size; ++i) {
        const auto between = static_cast<double>(arrival(i).stampNs - arrival(i + 1).stampNs);
        result.mean += between;
        squares += between * between;
        result.least = std::min(result.least, between);
        result.most = std::max(result.most, between);
    }
    const auto count = static_cast<double>(size - 1);
    result.mean /= count;
    result.deviation = std::sqrt(std::max(0.0, squares / count - result.mean * result.mean));
    return result;
}

} // namespace posewire::model
