// SPDX-License-Identifier: MIT
#include "core/model/sample_step.h"

#include <algorithm>
#include <span>

namespace posewire::model {

void SampleStep::add(std::uint32_t difference) {
    if (difference == 0) {
        return;
    }
    m_differences[m_count % kKept] = difference;
    ++m_count;
    // One more of the same kind changes nothing.
    if (difference != m_value) {
        m_value = mostFrequent();
    }
}

std::uint32_t SampleStep::mostFrequent() const {
    const std::size_t count = std::min(m_count, kKept);
    if (count < kLeast) {
        return 0;
    }
    auto sorted = m_differences;
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(count);
    std::sort(sorted.begin(), end);
    std::uint32_t best = 0;
    std::ptrdiff_t most = 0;
    for (auto from = sorted.begin(); from != end;) {
        const auto to = std::upper_bound(from, end, *from);
        // Of equally frequent ones the largest: a doubtful stream is irregular rather than lossy.
        if (to - from >= most) {
            most = to - from;
            best = *from;
        }
        from = to;
    }
    const auto multiples =
        std::count_if(sorted.begin(), end, [best](std::uint32_t value) { return value % best == 0; });
    return 10 * static_cast<std::size_t>(multiples) >= 9 * count ? best : 0;
}

} // namespace posewire::model
