// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/types.h"

#include <bit>
#include <cstring>

/// Network byte order (§2.5.11) to and from native values. The caller guarantees the room.
namespace posewire::wire {

inline std::uint16_t load16(const std::byte* from) {
    std::uint16_t value;
    std::memcpy(&value, from, sizeof value);
    return std::endian::native == std::endian::little ? __builtin_bswap16(value) : value;
}

inline std::uint32_t load32(const std::byte* from) {
    std::uint32_t value;
    std::memcpy(&value, from, sizeof value);
    return std::endian::native == std::endian::little ? __builtin_bswap32(value) : value;
}

inline void store16(std::byte* to, std::uint16_t value) {
    value = std::endian::native == std::endian::little ? __builtin_bswap16(value) : value;
    std::memcpy(to, &value, sizeof value);
}

inline void store32(std::byte* to, std::uint32_t value) {
    value = std::endian::native == std::endian::little ? __builtin_bswap32(value) : value;
    std::memcpy(to, &value, sizeof value);
}

/// Any value of a layout: an integer, a float, an array of floats or of characters.
template <class Value>
void loadValue(const std::byte* from, Value& value) {
    if constexpr (sizeof(Value) == 1) {
        value = std::to_integer<Value>(*from);
    } else if constexpr (sizeof(Value) == 2) {
        value = load16(from);
    } else {
        static_assert(sizeof(Value) == 4);
        value = std::bit_cast<Value>(load32(from));
    }
}

template <class Element, std::size_t N>
void loadValue(const std::byte* from, std::array<Element, N>& values) {
    for (std::size_t i = 0; i < N; ++i) {
        loadValue(from + sizeof(Element) * i, values[i]);
    }
}

template <class Value>
void storeValue(std::byte* to, Value value) {
    if constexpr (sizeof(Value) == 1) {
        *to = static_cast<std::byte>(value);
    } else if constexpr (sizeof(Value) == 2) {
        store16(to, value);
    } else {
        static_assert(sizeof(Value) == 4);
        store32(to, std::bit_cast<std::uint32_t>(value));
    }
}

template <class Element, std::size_t N>
void storeValue(std::byte* to, const std::array<Element, N>& values) {
    for (std::size_t i = 0; i < N; ++i) {
        storeValue(to + sizeof(Element) * i, values[i]);
    }
}

} // namespace posewire::wire
