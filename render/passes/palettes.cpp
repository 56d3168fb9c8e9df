// SPDX-License-Identifier: MIT
#include "render/passes/palettes.h"

#include "render/passes/shader_sources.h"

namespace posewire::render {

Palettes Palettes::create() {
    Palettes palettes;
    palettes.m_buffer = gl::Buffer::create();
    palettes.m_buffer.allocate(kJointCount * sizeof(DualQuaternion), gl::Buffer::Usage::Stream);
    palettes.m_texture = gl::Texture::overBuffer(palettes.m_buffer);
    return palettes;
}

void Palettes::upload(const Frame& frame) {
    std::vector<DualQuaternion> all;
    all.reserve(frame.characters.size() * kJointCount);
    for (const DrawnCharacter& character : frame.characters) {
        const std::span<const DualQuaternion> palette =
            character.instance->palette.first(character.mesh->jointBoxes.size());
        all.insert(all.end(), palette.begin(), palette.end());
    }
    upload(all);
}

void Palettes::upload(std::span<const DualQuaternion> palette) {
    if (!palette.empty()) {
        m_buffer.upload(palette, gl::Buffer::Usage::Stream);
    }
}

void Palettes::bind() const {
    m_texture.bind(kPaletteUnit);
}

} // namespace posewire::render
