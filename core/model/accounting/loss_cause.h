// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace posewire::model {

/// Whose loss it was. Unknown is an answer: nothing is guessed.
enum class LossCause : std::uint8_t { ThisComputer, Network, Sender, Unknown };
inline constexpr std::size_t kLossCauses = 4;

/// "this computer", "network", "sender", "unknown".
[[nodiscard]] std::string_view nameOf(LossCause cause);

} // namespace posewire::model
