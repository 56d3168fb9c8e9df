// SPDX-License-Identifier: MIT
#pragma once

#include "core/feed/series_feed.h"
#include "core/field/field.h"
#include "core/filter/filter.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace posewire::feed {

/// A signal as it is written, such as `position.z of "Left Hand"`.
struct Expression {
    std::string text; ///< as written, without spaces around it: the name of its curve
    field::Dimension dimension = field::Dimension::None;
    std::string unit;                ///< of its values: "m", "°/s"; empty for plain numbers
    std::vector<std::uint8_t> types; ///< message types that it reads, in order; empty: packets of any type
    Signal signal;                   ///< copies read on their own
};

/// Compiles one signal in the language of filters (see filterReference()); the error says where it is wrong.
[[nodiscard]] tl::expected<Expression, filter::FilterError> parseSignal(std::string_view text);

} // namespace posewire::feed
