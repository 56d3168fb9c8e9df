// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/handle.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <tl/expected.hpp>

namespace posewire::render::gl {

/// What a program is made of: texts that are joined in order after the #version line.
struct ProgramSource {
    std::string_view name;
    std::span<const std::string_view> vertex;
    std::span<const std::string_view> fragment;
    /// Outputs of the vertex shader to record, one after the other; then there may be no fragment shader.
    std::span<const char* const> recorded = {};
};

/// A linked program of GLSL 3.30.
class Program {
public:
    /// The error is the compiler's own text, with the name of the program and the stage.
    static tl::expected<Program, std::string> create(const ProgramSource& source);

    Program() = default;
    unsigned name() const { return m_handle.name(); }
    void use() const;

    /// A uniform that the program does not use is ignored. The program must be in use.
    void set(std::string_view uniform, int value);
    void set(std::string_view uniform, float value);
    void set(std::string_view uniform, const glm::vec3& value);
    void set(std::string_view uniform, const glm::vec4& value);
    void set(std::string_view uniform, std::span<const glm::vec4> values);

    /// Ties a uniform block to a binding point.
    void bindBlock(const char* block, unsigned index) const;

private:
    struct Uniform {
        std::string name;
        int location;
    };

    void readUniforms();
    int locate(std::string_view uniform) const;

    Handle<deleteProgram> m_handle;
    std::vector<Uniform> m_uniforms;
};

} // namespace posewire::render::gl
