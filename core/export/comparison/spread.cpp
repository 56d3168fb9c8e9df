// SPDX-License-Identifier: MIT
#include "core/export/comparison/spread.h"

#include <algorithm>
#include <cmath>

namespace posewire::exporting {
namespace {

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

} // namespace

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

} // namespace posewire::exporting
