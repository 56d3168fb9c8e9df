// SPDX-License-Identifier: MIT
#include "core/model/accounting/nominal_rate.h"

#include <cmath>

namespace posewire::model {
namespace {

constexpr std::uint32_t kLeastSpanMs = 500;
constexpr std::uint32_t kBaseSpanMs = 10'000;
constexpr std::uint32_t kLongestStepMs = 5'000;
constexpr double kJumpMs = 100;

} // namespace

bool NominalRate::continues(const Mark& mark) const {
    const auto samples = static_cast<std::int32_t>(mark.sample - m_newest.sample);
    const auto milliseconds = static_cast<std::int32_t>(mark.timeCode - m_newest.timeCode);
    if (samples < 0 || milliseconds < 0 || milliseconds > static_cast<std::int32_t>(kLongestStepMs)) {
        return false;
    }
    const auto hz = frameHz();
    return !hz || std::abs(milliseconds - samples * 1000.0 / *hz) < kJumpMs;
}

void NominalRate::add(std::uint32_t sample, std::uint32_t timeCode) {
    const Mark mark{sample, timeCode};
    if (!m_hasMarks || !continues(mark)) {
        m_base = m_nextBase = mark;
        m_hasMarks = true;
    }
    m_newest = mark;
    if (mark.timeCode - m_nextBase.timeCode >= kBaseSpanMs) {
        m_base = m_nextBase;
        m_nextBase = mark;
    }
}

std::optional<double> NominalRate::frameHz() const {
    const std::uint32_t milliseconds = m_newest.timeCode - m_base.timeCode;
    const std::uint32_t samples = m_newest.sample - m_base.sample;
    if (!m_hasMarks || milliseconds < kLeastSpanMs || samples == 0) {
        return std::nullopt;
    }
    const double hz = samples * 1000.0 / milliseconds;
    // Either end is cut to a whole millisecond.
    const double uncertainty = hz * 1.0 / milliseconds;
    return std::abs(hz - std::round(hz)) <= uncertainty ? std::round(hz) : hz;
}

} // namespace posewire::model
