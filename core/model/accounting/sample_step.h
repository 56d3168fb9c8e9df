// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace posewire::model {

/// A step is judged by this many of the newest differences between successive sample counters.
inline constexpr std::size_t kStepDifferences = 64;
/// A change of step is looked for among this many.
inline constexpr std::size_t kStepHistory = 128;

/// The sender's own spacing of sample counters, since a stream may be sent at a fraction of the capture rate:
/// the most frequent of the newest kStepDifferences, the smallest of equally frequent ones, if it is at
/// least 40 % of them and at least 90 % of them are multiples of it. Loss makes multiples, never fractions.
/// 0 if there is none: the stream is irregular.
[[nodiscard]] std::uint32_t findStep(std::span<const std::uint32_t> differences);

/// True if a step that was found stays the step: at least 60 % of the newest kStepDifferences are multiples
/// of it, and at least 20 % are equal to it.
[[nodiscard]] bool holdsStep(std::span<const std::uint32_t> differences, std::uint32_t step);

/// The step after another difference. `held` is the one until now, 0 if there was none. It is held on to
/// once kStepDifferences differences are known; until then every difference decides afresh.
[[nodiscard]] std::uint32_t nextStep(std::span<const std::uint32_t> differences, std::uint32_t held);

/// Index of the difference at which the spacing most likely changed from one step to another; that
/// difference itself may belong to neither. A step of 0 means irregular spacing.
[[nodiscard]] std::size_t placeOfChange(std::span<const std::uint32_t> differences, std::uint32_t before,
                                        std::uint32_t after);

} // namespace posewire::model
