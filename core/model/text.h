// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace posewire::model {

/// At most so many bytes of a text, with "…" where something is cut off. No character is cut in two.
inline std::string clippedText(std::string text, std::size_t most) {
    constexpr std::string_view kEllipsis = "…";
    if (text.size() > most) {
        std::size_t end = most - kEllipsis.size();
        while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80U) {
            --end;
        }
        text.resize(end);
        text += kEllipsis;
        text.shrink_to_fit();
    }
    return text;
}

/// "12 345": a number as people read it, with narrow spaces that end no line.
inline std::string grouped(std::uint64_t number) {
    constexpr std::string_view kSpace = "\u202f";
    std::string digits = std::to_string(number);
    for (std::size_t place = digits.size(); place > 3; place -= 3) {
        digits.insert(place - 3, kSpace);
    }
    return digits;
}

/// "007": with zeros in front.
inline std::string padded(std::int64_t number, std::size_t width) {
    const std::string digits = std::to_string(number);
    return std::string(width - std::min(width, digits.size()), '0') + digits;
}

/// "−0.25", whatever the locale; "–" for what is no number.
inline std::string fixedText(double value, int decimals) {
    constexpr std::size_t kMost = std::numeric_limits<double>::max_exponent10 + 32;
    if (!std::isfinite(value)) {
        return "–";
    }
    std::array<char, kMost> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), std::abs(value),
                                   std::chars_format::fixed, std::clamp(decimals, 0, 20))
                         .ptr;
    const std::string digits(text.data(), end);
    const bool isZero = digits.find_first_not_of("0.") == std::string::npos;
    return value < 0 && !isZero ? "−" + digits : digits;
}

/// "+12 mm": with a sign.
inline std::string millimetresText(double metres) {
    const std::string text = fixedText(metres * 1000.0, 1) + " mm";
    return metres > 0 ? "+" + text : text;
}

} // namespace posewire::model
