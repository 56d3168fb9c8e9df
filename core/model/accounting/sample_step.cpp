// SPDX-License-Identifier: MIT
#include "core/model/accounting/sample_step.h"

#include <algorithm>
#include <array>

namespace posewire::model {
namespace {

using Differences = std::span<const std::uint32_t>;

Differences newest(Differences differences, std::size_t most = kStepDifferences) {
    return differences.size() > most ? differences.last(most) : differences;
}

/// `equal`, `multiples`: the least shares, in percent.
bool isStep(Differences differences, std::uint32_t step, std::size_t equal, std::size_t multiples) {
    const auto isMultiple = [step](std::uint32_t value) { return value == step || value % step == 0; };
    const auto isShare = [&](std::size_t percent, std::ptrdiff_t count) {
        return 100 * static_cast<std::size_t>(count) >= percent * differences.size();
    };
    return isShare(equal, std::ranges::count(differences, step)) &&
           isShare(multiples, std::ranges::count_if(differences, isMultiple));
}

/// The smallest of equally frequent ones.
std::uint32_t mostFrequent(Differences differences) {
    std::array<std::uint32_t, kStepDifferences> values{};
    const auto end = std::ranges::copy(differences, values.begin()).out;
    std::sort(values.begin(), end);
    std::uint32_t best = 0;
    std::ptrdiff_t most = 0;
    for (auto from = values.begin(); from != end;) {
        const auto to = std::upper_bound(from, end, *from);
        if (to - from > most) {
            most = to - from;
            best = *from;
        }
        from = to;
    }
    return best;
}

constexpr std::uint32_t kMostUnlikely = 8;

struct Side {
    std::uint32_t step = 0;
    std::uint32_t usual = 0; ///< if there is no step

    /// How much a difference speaks against it: the more, the more samples would be lost, and most where it
    /// is no multiple of the step.
    [[nodiscard]] std::uint32_t unlikeliness(std::uint32_t difference) const {
        if (difference == (step == 0 ? usual : step)) {
            return 0;
        }
        if (step == 0) {
            return 2;
        }
        return difference % step != 0 ? 2 * kMostUnlikely
                                      : std::min(2 * (difference / step - 1), kMostUnlikely);
    }
};

} // namespace

std::uint32_t findStep(Differences differences) {
    const Differences looked = newest(differences);
    if (looked.empty()) {
        return 0;
    }
    const std::uint32_t step = mostFrequent(looked);
    return isStep(looked, step, 40, 90) ? step : 0;
}

bool holdsStep(Differences differences, std::uint32_t step) {
    return isStep(newest(differences), step, 20, 60);
}

std::uint32_t nextStep(Differences differences, std::uint32_t held) {
    const bool isHeld = held != 0 && differences.size() >= kStepDifferences && holdsStep(differences, held);
    return isHeld ? held : findStep(differences);
}

std::size_t placeOfChange(Differences differences, std::uint32_t before, std::uint32_t after) {
    const Side old{before, 0};
    const Side next{after, mostFrequent(newest(differences, kStepDifferences / 2))};
    std::int64_t score = 0;
    std::int64_t least = INT64_MAX;
    std::size_t place = 0;
    for (std::size_t i = 0; i < differences.size(); ++i) {
        const std::int64_t own = next.unlikeliness(differences[i]);
        const std::int64_t other = old.unlikeliness(differences[i]);
        // Relative to all being behind; the one at the place may be of either, or of neither.
        const std::int64_t here = score - own + std::min({own, other, std::int64_t{kMostUnlikely}});
        if (here <= least) {
            least = here;
            place = i;
        }
        score += other - own;
    }
    return place;
}

} // namespace posewire::model
