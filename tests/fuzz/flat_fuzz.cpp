// SPDX-License-Identifier: MIT
#include "render/mesh/bone_mapping.h"
#include "render/mesh/flat_character.h"
#include "render/mesh/own_body.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

// Any bytes in place of a flat character: those that are taken are valid, come back byte for byte, and can be
// posed or say why not.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace posewire::render;
    const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(data), size);
    const auto character = unflatten(bytes);
    if (!character) {
        return character.error().empty() ? std::abort(), 1 : 0;
    }
    if (!validate(*character) || !std::ranges::equal(flatten(*character), bytes)) {
        std::abort();
    }
    static_cast<void>(makeOwnBody(*character, mapBones(character->bones), {}));
    return 0;
}
