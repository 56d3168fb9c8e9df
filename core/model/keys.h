// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace posewire::model {

/// A character: one sender's character ID.
struct CharacterKey {
    log::SenderId sender{};
    std::uint8_t character = 0;

    friend auto operator<=>(const CharacterKey&, const CharacterKey&) = default;
};

} // namespace posewire::model

template <>
struct std::hash<posewire::model::CharacterKey> {
    std::size_t operator()(const posewire::model::CharacterKey& key) const noexcept {
        return std::hash<std::uint64_t>{}(static_cast<std::uint64_t>(key.sender) << 8 | key.character);
    }
};
