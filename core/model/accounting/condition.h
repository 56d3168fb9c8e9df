// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace posewire::model {

/// How a character does, for all who show it.
struct Condition {
    /// Seconds of silence that are a warning, and those that are an error, also before an event reports it.
    static constexpr double kSilentS = 0.25;
    static constexpr double kStaleS = 1.0;

    enum class Level : std::uint8_t { Good, Warning, Error };
    Level level = Level::Good;
    std::string reason; ///< one line; empty where it is good
    /// What it rests on where that is an event: its number. Else silence or a contradiction.
    std::optional<std::uint64_t> event{};
};

} // namespace posewire::model
