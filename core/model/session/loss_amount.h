// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace posewire::model {

/// How much was lost, in a few words: "2.3 %" of the samples expected where that says more than "37 samples";
/// the noun is for a number, and may be empty.
[[nodiscard]] std::string lossAmount(std::uint64_t samples, std::uint64_t expected, std::string_view noun);

} // namespace posewire::model
