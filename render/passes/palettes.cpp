// SPDX-License-Identifier: MIT
#include "render/passes/palettes.h"

#include "render/passes/shader_sources.h"

#include <utility>

namespace posewire::render {
namespace {

/// Two texels for each joint: the stretch of the mesh's own cube, and in w the joint's segment.
void addFit(const DrawnCharacter& character, std::vector<glm::vec4>& texels) {
    const GpuMesh& mesh = *character.mesh;
    const std::span<const Stretch> fit = character.instance->fit;
    for (std::size_t joint = 0; joint < mesh.jointBoxes.size(); ++joint) {
        const Stretch stretch = fit.empty() ? Stretch() : fit[joint];
        texels.emplace_back(mesh.cube.side * stretch.scale, static_cast<float>(mesh.segments[joint]));
        texels.emplace_back(stretch(mesh.cube.low), 0.0F);
    }
}

} // namespace

Palettes::Store Palettes::Store::create() {
    Store store;
    store.buffer = gl::Buffer::create();
    store.buffer.allocate(kJointCount * sizeof(DualQuaternion), gl::Buffer::Usage::Stream);
    store.texture = gl::Texture::overBuffer(store.buffer);
    return store;
}

void Palettes::upload(const Frame& frame) {
    m_motionsOut.clear();
    m_fitsOut.clear();
    for (const DrawnCharacter& character : frame.characters) {
        const std::span<const DualQuaternion> palette =
            character.instance->palette.first(character.mesh->jointBoxes.size());
        m_motionsOut.insert(m_motionsOut.end(), palette.begin(), palette.end());
        addFit(character, m_fitsOut);
    }
    if (m_motionsOut.empty()) {
        return;
    }
    m_motions.next().buffer.write(std::as_bytes(std::span(m_motionsOut)), gl::Buffer::Usage::Stream);
    if (m_fitsOut != m_fitsIn) {
        m_fits.buffer.upload(std::as_bytes(std::span(m_fitsOut)), gl::Buffer::Usage::Static);
        std::swap(m_fitsIn, m_fitsOut);
    }
}

void Palettes::bind() const {
    m_motions.current().texture.bind(kPaletteUnit);
    m_fits.texture.bind(kFitUnit);
}

} // namespace posewire::render
