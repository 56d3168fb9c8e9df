// SPDX-License-Identifier: MIT
#include "render/passes/shader_sources.h"

#include "shader_files.h"

namespace posewire::render {

tl::expected<gl::Program, std::string> createProgram(const ProgramParts& parts) {
    std::vector<std::string_view> vertex;
    if (!parts.defines.empty()) {
        vertex.push_back(parts.defines);
    }
    vertex.push_back(shaders::frameGlsl());
    if (parts.skins) {
        vertex.push_back(shaders::skinningGlsl());
    }
    if (parts.isFloor) {
        vertex.push_back(shaders::floorGlsl());
    }
    vertex.push_back(parts.vertex);
    std::vector<std::string_view> fragment;
    if (!parts.fragment.empty()) {
        if (!parts.defines.empty()) {
            fragment.push_back(parts.defines);
        }
        fragment.push_back(shaders::frameGlsl());
        if (parts.isFloor) {
            fragment.push_back(shaders::floorGlsl());
        }
        if (parts.paints) {
            fragment.push_back(shaders::suitGlsl());
        }
        fragment.push_back(parts.fragment);
    }
    tl::expected<gl::Program, std::string> program =
        gl::Program::create({parts.name, vertex, fragment, parts.recorded});
    if (!program) {
        return program;
    }
    program->bindBlock("Frame", kFrameBinding);
    program->use();
    program->set("palette", static_cast<int>(kPaletteUnit));
    program->set("fits", static_cast<int>(kFitUnit));
    program->set("shadowMap", static_cast<int>(kShadowMapUnit));
    program->set("floorShadow", static_cast<int>(kFloorShadowUnit));
    program->set("shadowDepth", static_cast<int>(kShadowDepthUnit));
    program->set("partTexture", static_cast<int>(kPartTextureUnit));
    program->set("picture", static_cast<int>(kPictureUnit));
    return program;
}

} // namespace posewire::render
