// SPDX-License-Identifier: MIT
#include "render/passes/shader_sources.h"

#include "render/mesh/joints.h"
#include "shader_files.h"

namespace posewire::render {
namespace {

/// kJointCount and kJointSegments of joints.h for the shaders.
const std::string& jointTable() {
    static const std::string kText = [] {
        const std::string count = std::to_string(kJointCount);
        std::string text = "const int kJointCount = " + count + ";\nconst int kJointSegments[" + count +
                           "] = int[" + count + "](";
        for (std::size_t joint = 0; joint < kJointCount; ++joint) {
            text += (joint == 0 ? "" : ", ") + std::to_string(jointSegment(joint));
        }
        return text + ");\n";
    }();
    return kText;
}

} // namespace

tl::expected<gl::Program, std::string> createProgram(const ProgramParts& parts) {
    std::vector<std::string_view> vertex;
    if (!parts.defines.empty()) {
        vertex.push_back(parts.defines);
    }
    vertex.push_back(shaders::frameGlsl());
    if (parts.skins) {
        vertex.push_back(jointTable());
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
    program->set("shadowMap", static_cast<int>(kShadowMapUnit));
    program->set("floorShadow", static_cast<int>(kFloorShadowUnit));
    program->set("shadowDepth", static_cast<int>(kShadowDepthUnit));
    program->set("picture", static_cast<int>(kPictureUnit));
    return program;
}

} // namespace posewire::render
