// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/keys.h"
#include "core/model/session/metadata.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace posewire::model {

/// One character of a sender.
struct Character {
    CharacterKey key;
    std::size_t ordinal = 0; ///< place in the order of first appearance, for default colours
    Metadata metadata;
    log::Stamp lastStamp{};
    std::uint64_t firstPacket = 0;
    std::uint64_t lastPacket = 0;
    std::optional<CharacterKey> before; ///< see SessionView::predecessor
    std::optional<CharacterKey> after;  ///< who has this one as `before`
};

} // namespace posewire::model
