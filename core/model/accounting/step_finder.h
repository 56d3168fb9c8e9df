// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace posewire::model {

/// So many of the newest differences between successive sample counters decide about a step.
inline constexpr std::size_t kStepDifferences = 64;
/// So far back a change of step is looked for.
inline constexpr std::size_t kStepHistory = 128;

/// The sender's own spacing of sample counters, since a stream may be sent at a fraction of the capture rate:
/// the most frequent of the differences, provided at least 90 % of them are multiples of it. Loss makes
/// multiples, never fractions. Where that one is none, one that is nearly as frequent will do: the first
/// samples of a stream that loses some, and a stream that loses every second one for a while. 0 where there
/// is none. At most kStepDifferences differences are looked at, the newest.
[[nodiscard]] std::uint32_t findStep(std::span<const std::uint32_t> differences);

/// A lasting change of step.
struct StepChange {
    std::size_t place = 0;  ///< of the difference that belongs to neither
    std::uint32_t step = 0; ///< after it
};

/// Whether a step that held until now is not yet disproved: nearly all newest differences are multiples of it
/// and it is still among the frequent ones.
[[nodiscard]] bool stillHolds(std::span<const std::uint32_t> differences, std::uint32_t step);

/// Looks for a lasting change from `step` to another one among the newest kStepHistory differences. The place
/// is the one that leaves most differences equal to the old step before it and to the new one behind it.
[[nodiscard]] std::optional<StepChange> findStepChange(std::span<const std::uint32_t> differences,
                                                       std::uint32_t step);

/// The most frequent one; of equally frequent ones the smallest.
[[nodiscard]] std::uint32_t mostFrequent(std::span<const std::uint32_t> differences);

} // namespace posewire::model
