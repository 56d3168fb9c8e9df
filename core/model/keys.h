// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"

#include <compare>
#include <cstdint>

namespace posewire::model {

/// A character: one sender's character ID.
struct CharacterKey {
    log::SenderId sender{};
    std::uint8_t character = 0;

    friend auto operator<=>(const CharacterKey&, const CharacterKey&) = default;
};

} // namespace posewire::model
