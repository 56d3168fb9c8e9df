// SPDX-License-Identifier: MIT
#include "core/model/accounting/clock_skew.h"

#include <algorithm>

namespace posewire::model {
namespace {

constexpr std::int64_t kLeastPartNs = 250'000'000;
constexpr std::int64_t kMostParts = 128;
/// Fewer parts than these show no skew.
constexpr std::size_t kLeastParts = 8;
constexpr double kSecondsPerNs = 1e-9;

} // namespace

ClockFit::ClockFit(std::int64_t spanNs) : m_partNs(std::max(kLeastPartNs, spanNs / kMostParts)) {}

void ClockFit::Sums::add(double atSeconds, double differenceMs) {
    ++count;
    seconds += atSeconds;
    ms += differenceMs;
    squares += atSeconds * atSeconds;
    products += atSeconds * differenceMs;
}

void ClockFit::add(std::int64_t stampNs, double differenceMs) {
    if (!m_hasFirst) {
        m_hasFirst = true;
        m_firstNs = m_leastNs = stampNs;
        m_firstMs = m_leastMs = differenceMs;
        return;
    }
    const std::int64_t part = (stampNs - m_firstNs) / m_partNs;
    if (part != m_part) {
        m_sums.add(static_cast<double>(m_leastNs - m_firstNs) * kSecondsPerNs, m_leastMs - m_firstMs);
        m_part = part;
        m_leastNs = stampNs;
        m_leastMs = differenceMs;
    } else if (differenceMs < m_leastMs) {
        m_leastNs = stampNs;
        m_leastMs = differenceMs;
    }
}

ClockSkew ClockFit::skew() const {
    Sums sums = m_sums;
    const double lastSeconds = static_cast<double>(m_leastNs - m_firstNs) * kSecondsPerNs;
    sums.add(lastSeconds, m_leastMs - m_firstMs);
    const auto count = static_cast<double>(sums.count);
    const double square = sums.squares - sums.seconds * sums.seconds / count;
    if (!m_hasFirst || sums.count < kLeastParts || square <= 0) {
        return {};
    }
    // Ours minus theirs grows where theirs is slow; 1 ms in a second is 1,000 ppm.
    const double slope = -(sums.products - sums.seconds * sums.ms / count) / square;
    return {slope * 1e3, slope * lastSeconds};
}

} // namespace posewire::model
