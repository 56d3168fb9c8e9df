// SPDX-License-Identifier: MIT
#include "core/model/accounting/step_finder.h"

#include <algorithm>
#include <array>

namespace posewire::model {
namespace {

using Differences = std::span<const std::uint32_t>;

// Where many are known, a step that is not the most frequent one must be this nearly so.
constexpr double kNearlyMost = 0.8;
constexpr double kFewNearlyMost = 0.5;
constexpr std::size_t kFew = 16;
constexpr double kStillFrequent = 0.6;
// Multiples of a step are what loss makes too: a change to one must last.
constexpr std::size_t kLastingMultiples = 32;
constexpr std::size_t kLastingFractions = 7;
constexpr std::size_t kLeastBefore = 8;

Differences newest(Differences differences, std::size_t most) {
    return differences.size() > most ? differences.last(most) : differences;
}

std::size_t multiples(Differences differences, std::uint32_t step) {
    return static_cast<std::size_t>(
        std::count_if(differences.begin(), differences.end(),
                      [step](std::uint32_t value) { return value == step || value % step == 0; }));
}

bool areMostlyMultiples(Differences differences, std::uint32_t step) {
    return 10 * multiples(differences, step) >= 9 * differences.size();
}

struct Candidate {
    std::uint32_t value = 0;
    std::size_t count = 0;
};

struct Candidates {
    std::array<Candidate, kStepDifferences> items{};
    std::size_t size = 0;
};

/// Most frequent first, of equally frequent ones the smallest first.
Candidates byFrequency(Differences differences) {
    std::array<std::uint32_t, kStepDifferences> sorted{};
    std::copy(differences.begin(), differences.end(), sorted.begin());
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(differences.size());
    std::sort(sorted.begin(), end);
    Candidates found;
    for (auto from = sorted.begin(); from != end;) {
        const auto to = std::upper_bound(from, end, *from);
        found.items[found.size++] = {*from, static_cast<std::size_t>(to - from)};
        from = to;
    }
    std::stable_sort(found.items.begin(), found.items.begin() + static_cast<std::ptrdiff_t>(found.size),
                     [](const Candidate& a, const Candidate& b) { return a.count > b.count; });
    return found;
}

constexpr std::uint32_t kMostLost = 4;

/// The most frequent one that is no multiple of a step; 0 where there is none.
std::uint32_t mostFrequentFraction(Differences differences, std::uint32_t step) {
    const Candidates candidates = byFrequency(differences);
    for (std::size_t i = 0; i < candidates.size; ++i) {
        if (candidates.items[i].value % step != 0) {
            return candidates.items[i].value;
        }
    }
    return 0;
}

/// How unlikely a difference is for a step: each sample lost makes it so, and what is no multiple far more.
std::uint32_t unlikeliness(std::uint32_t difference, std::uint32_t step) {
    constexpr std::uint32_t kFraction = 8;
    return difference == step       ? 0
           : difference % step != 0 ? kFraction
                                    : std::min(difference / step - 1, kMostLost);
}

/// The place where differences before and behind it are the most likely; the latest of equal ones.
std::size_t bestPlace(Differences differences, std::uint32_t before, std::uint32_t after) {
    std::int64_t score = 0;
    std::int64_t least = INT64_MAX;
    std::size_t place = 0;
    for (std::size_t i = 0; i < differences.size(); ++i) {
        const std::int64_t own = unlikeliness(differences[i], after);
        const std::int64_t other = unlikeliness(differences[i], before);
        // Relative to all being behind; the one at the place may be of either.
        const std::int64_t here = score - own + std::min({own, other, std::int64_t{kMostLost}});
        if (here <= least) {
            least = here;
            place = i;
        }
        score += other - own;
    }
    return place;
}

bool isLasting(Differences differences, std::size_t place, std::uint32_t before, std::uint32_t after) {
    const Differences old = differences.first(place);
    const Differences rest = differences.subspan(place + 1);
    const auto equalOld = static_cast<std::size_t>(std::count(old.begin(), old.end(), before));
    const auto equal = static_cast<std::size_t>(std::count(rest.begin(), rest.end(), after));
    if (equalOld < kLeastBefore || rest.empty() || !areMostlyMultiples(rest, after)) {
        return false;
    }
    if (after % before == 0) {
        return rest.size() >= kLastingMultiples && 3 * equal >= rest.size();
    }
    const std::size_t fractions = rest.size() - multiples(rest, before);
    return fractions + 1 >= kLastingFractions && 2 * equal >= rest.size();
}

} // namespace

std::uint32_t mostFrequent(Differences differences) {
    const Differences looked = newest(differences, kStepDifferences);
    return looked.empty() ? 0 : byFrequency(looked).items[0].value;
}

std::uint32_t findStep(Differences differences) {
    const Differences looked = newest(differences, kStepDifferences);
    if (looked.empty()) {
        return 0;
    }
    const Candidates candidates = byFrequency(looked);
    const double nearly = looked.size() < kFew ? kFewNearlyMost : kNearlyMost;
    const double least = nearly * static_cast<double>(candidates.items[0].count);
    for (std::size_t i = 0; i < candidates.size; ++i) {
        const Candidate& candidate = candidates.items[i];
        if (static_cast<double>(candidate.count) < least) {
            break;
        }
        if (areMostlyMultiples(looked, candidate.value)) {
            return candidate.value;
        }
    }
    return 0;
}

bool stillHolds(Differences differences, std::uint32_t step) {
    const Differences looked = newest(differences, kStepHistory);
    if (step == 0 || !areMostlyMultiples(newest(differences, kStepDifferences), step)) {
        return false;
    }
    const auto count = [&](std::uint32_t value) { return std::count(looked.begin(), looked.end(), value); };
    return static_cast<double>(count(step)) >=
           kStillFrequent * static_cast<double>(count(mostFrequent(looked)));
}

std::optional<StepChange> findStepChange(Differences differences, std::uint32_t step) {
    const Differences looked = newest(differences, kStepHistory);
    const std::size_t skipped = differences.size() - looked.size();
    if (step == 0 || looked.size() < kLeastBefore + kLastingFractions) {
        return std::nullopt;
    }
    const Differences tail = newest(looked, kLastingMultiples + 1);
    const std::array candidates{mostFrequent(tail), mostFrequent(newest(looked, kLastingFractions)),
                                mostFrequentFraction(tail, step)};
    for (const std::uint32_t after : candidates) {
        if (after == step || after == 0) {
            continue;
        }
        const std::size_t place = bestPlace(looked, step, after);
        if (isLasting(looked, place, step, after)) {
            return StepChange{skipped + place, after};
        }
    }
    return std::nullopt;
}

} // namespace posewire::model
