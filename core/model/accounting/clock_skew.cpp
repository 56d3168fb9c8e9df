// SPDX-License-Identifier: MIT
#include "core/model/accounting/clock_skew.h"

#include <algorithm>

namespace posewire::model {
namespace {

constexpr log::Duration kLeastPart = std::chrono::milliseconds(250);
constexpr std::int64_t kMostParts = 128;
/// Fewer parts than these show no skew.
constexpr std::size_t kLeastParts = 8;

} // namespace

ClockFit::ClockFit(log::Duration span) : m_width(std::max<log::Duration>(kLeastPart, span / kMostParts)) {}

void ClockFit::Sums::add(double atSeconds, double differenceMs) {
    ++count;
    seconds += atSeconds;
    ms += differenceMs;
    squares += atSeconds * atSeconds;
    products += atSeconds * differenceMs;
}

void ClockFit::add(log::Stamp stamp, double differenceMs) {
    if (!m_hasFirst) {
        m_hasFirst = true;
        m_first = m_least = stamp;
        m_firstMs = m_leastMs = differenceMs;
        return;
    }
    const std::int64_t part = (stamp - m_first) / m_width;
    if (part != m_part) {
        m_sums.add(log::secondsOf(m_least - m_first), m_leastMs - m_firstMs);
        m_part = part;
        m_least = stamp;
        m_leastMs = differenceMs;
    } else if (differenceMs < m_leastMs) {
        m_least = stamp;
        m_leastMs = differenceMs;
    }
}

ClockSkew ClockFit::skew() const {
    Sums sums = m_sums;
    const double lastSeconds = log::secondsOf(m_least - m_first);
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
