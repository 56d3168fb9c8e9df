// SPDX-License-Identifier: MIT
#include "render/passes/instances.h"

#include <algorithm>
#include <cstddef>
#include <tuple>

#include <epoxy/gl.h>

namespace posewire::render {
namespace {

/// A bit for each segment of that provenance.
int segmentsOf(const CharacterLook& look, Provenance provenance) {
    unsigned bits = 0;
    for (std::size_t segment = 0; segment < kSegmentCount; ++segment) {
        bits |= look.provenance[segment] == provenance ? 1U << segment : 0U;
    }
    return static_cast<int>(bits);
}

bool hasMarks(const CharacterLook& look) {
    return selectedBit(look) != 0 ||
           std::ranges::any_of(look.provenance, [](Provenance one) { return one != Provenance::Sent; });
}

bool isOwn(const GpuMesh& mesh) {
    return !mesh.parts.empty();
}

} // namespace

Instances::Data Instances::dataOf(const DrawnCharacter& character) {
    const CharacterLook& look = character.instance->look;
    return {character.firstTexel,
            selectedBit(look),
            segmentsOf(look, Provenance::Solved),
            segmentsOf(look, Provenance::Assumed),
            look.colour,
            std::clamp(look.dim, 0.0F, 1.0F),
            std::clamp(look.opacity, 0.0F, 1.0F),
            look.isHatched ? 1.0F : 0.0F};
}

void Instances::addRuns(const GpuMesh* DrawnCharacter::*mesh, bool paints, int atOnce,
                        std::vector<InstanceRun>& runs) {
    const auto isMarked = [paints](const DrawnCharacter* one) {
        return paints && hasMarks(one->instance->look);
    };
    std::ranges::sort(m_ordered, {},
                      [&](const DrawnCharacter* one) { return std::tuple(one->*mesh, isMarked(one), one); });
    for (const DrawnCharacter* character : m_ordered) {
        const GpuMesh* drawn = character->*mesh;
        const bool marks = isMarked(character);
        const bool goesOn = !runs.empty() && runs.back().mesh == drawn && runs.back().hasMarks == marks &&
                            runs.back().own == nullptr && (atOnce == 0 || runs.back().count < atOnce);
        if (goesOn) {
            ++runs.back().count;
        } else {
            runs.push_back(
                {drawn, static_cast<int>(m_data.size()), 1, marks, isOwn(*drawn) ? character : nullptr});
        }
        m_data.push_back(dataOf(*character));
    }
}

void Instances::upload(const Frame& frame, int atOnce) {
    m_data.clear();
    m_solids.clear();
    m_casters.clear();
    m_ordered.clear();
    for (const DrawnCharacter& character : frame.characters) {
        m_data.push_back(dataOf(character));
        if (character.isSolid()) {
            m_ordered.push_back(&character);
        }
    }
    if (m_data.empty()) {
        return;
    }
    addRuns(&DrawnCharacter::drawn, true, atOnce, m_solids);
    m_ordered.clear();
    for (const DrawnCharacter& character : frame.characters) {
        if (character.castsShadow()) {
            m_ordered.push_back(&character);
        }
    }
    addRuns(&DrawnCharacter::caster, false, atOnce, m_casters);
    m_buffers.next().write(std::as_bytes(std::span(m_data)), gl::Buffer::Usage::Stream);
}

InstanceRun Instances::only(const Frame& frame, const DrawnCharacter& character, const GpuMesh& mesh) {
    return {&mesh, static_cast<int>(&character - frame.characters.data()), 1,
            posewire::render::hasMarks(character.instance->look), isOwn(mesh) ? &character : nullptr};
}

/// Without a base instance, which OpenGL 3.3 does not know.
void Instances::attach(const InstanceRun& run) const {
    using Kind = gl::Attribute::Kind;
    const gl::Buffer& buffer = m_buffers.current();
    const std::size_t first = sizeof(Data) * static_cast<std::size_t>(run.first);
    const auto attach = [&](unsigned location, int components, std::size_t offset, Kind kind) {
        run.mesh->array.attach(buffer, sizeof(Data), {location, components, first + offset, kind}, 1);
    };
    attach(5, 4, offsetof(Data, firstTexel), Kind::Integer);
    attach(6, 4, offsetof(Data, colour), Kind::Float);
    attach(7, 2, offsetof(Data, opacity), Kind::Float);
    run.mesh->array.bind();
}

void Instances::draw(const InstanceRun& run) const {
    attach(run);
    glDrawElementsInstanced(GL_TRIANGLES, run.mesh->indexCount, GL_UNSIGNED_INT, nullptr, run.count);
}

void Instances::drawPart(const InstanceRun& run, const MeshPart& part) {
    const auto first = sizeof(std::uint32_t) * std::uintptr_t{part.firstIndex};
    glDrawElementsInstanced(GL_TRIANGLES, static_cast<int>(part.indexCount), GL_UNSIGNED_INT,
                            reinterpret_cast<const void*>(first), // NOLINT: the API's own convention
                            run.count);
}

void Instances::drawPoints(const InstanceRun& run) const {
    attach(run);
    glDrawArraysInstanced(GL_POINTS, 0, run.mesh->vertexCount, run.count);
}

} // namespace posewire::render
