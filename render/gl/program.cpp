// SPDX-License-Identifier: MIT
#include "render/gl/program.h"

#include <algorithm>
#include <array>

#include <epoxy/gl.h>

namespace posewire::render::gl {
namespace {

using ShaderHandle = Handle<deleteShader>;

constexpr std::string_view kVersion = "#version 330 core\n";

std::string shaderLog(unsigned shader) {
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string text(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetShaderInfoLog(shader, length, nullptr, text.data());
    return text;
}

std::string programLog(unsigned program) {
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string text(static_cast<std::size_t>(std::max(length, 1)), '\0');
    glGetProgramInfoLog(program, length, nullptr, text.data());
    return text;
}

tl::expected<ShaderHandle, std::string> compile(GLenum stage, std::span<const std::string_view> parts) {
    ShaderHandle shader(glCreateShader(stage));
    std::vector<const char*> texts{kVersion.data()};
    std::vector<GLint> lengths{static_cast<GLint>(kVersion.size())};
    for (const std::string_view part : parts) {
        texts.push_back(part.data());
        lengths.push_back(static_cast<GLint>(part.size()));
    }
    glShaderSource(shader.name(), static_cast<GLsizei>(texts.size()), texts.data(), lengths.data());
    glCompileShader(shader.name());
    GLint compiled = 0;
    glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    if (compiled == 0) {
        return tl::unexpected(shaderLog(shader.name()));
    }
    return shader;
}

/// Compiles one stage and attaches it; no parts, no stage.
tl::expected<void, std::string> attach(unsigned program, GLenum stage,
                                       std::span<const std::string_view> parts) {
    if (parts.empty()) {
        return {};
    }
    tl::expected<ShaderHandle, std::string> shader = compile(stage, parts);
    if (!shader) {
        return tl::unexpected((stage == GL_VERTEX_SHADER ? "vertex shader: " : "fragment shader: ") +
                              shader.error());
    }
    glAttachShader(program, shader->name());
    return {};
}

} // namespace

tl::expected<Program, std::string> Program::create(const ProgramSource& source) {
    Program program;
    program.m_handle = Handle<deleteProgram>(glCreateProgram());
    const unsigned name = program.name();
    const auto failed = [&](const std::string& text) {
        return tl::unexpected("program " + std::string(source.name) + ", " + text);
    };
    if (const auto attached = attach(name, GL_VERTEX_SHADER, source.vertex); !attached) {
        return failed(attached.error());
    }
    if (const auto attached = attach(name, GL_FRAGMENT_SHADER, source.fragment); !attached) {
        return failed(attached.error());
    }
    if (!source.recorded.empty()) {
        glTransformFeedbackVaryings(name, static_cast<GLsizei>(source.recorded.size()),
                                    source.recorded.data(), GL_INTERLEAVED_ATTRIBS);
    }
    glLinkProgram(name);
    GLint linked = 0;
    glGetProgramiv(name, GL_LINK_STATUS, &linked);
    if (linked == 0) {
        return failed("linking: " + programLog(name));
    }
    program.readUniforms();
    return program;
}

void Program::readUniforms() {
    GLint count = 0;
    glGetProgramiv(name(), GL_ACTIVE_UNIFORMS, &count);
    for (GLint i = 0; i < count; ++i) {
        std::array<char, 128> text{};
        GLint size = 0;
        GLenum type = 0;
        glGetActiveUniform(name(), static_cast<GLuint>(i), static_cast<GLsizei>(text.size()), nullptr, &size,
                           &type, text.data());
        std::string uniform(text.data());
        const int location = glGetUniformLocation(name(), uniform.c_str());
        // An array is listed with its first element.
        uniform = uniform.substr(0, uniform.find('['));
        if (location >= 0) {
            m_uniforms.push_back({std::move(uniform), location});
        }
    }
}

int Program::locate(std::string_view uniform) const {
    const auto found = std::ranges::find(m_uniforms, uniform, &Uniform::name);
    return found == m_uniforms.end() ? -1 : found->location;
}

void Program::use() const {
    glUseProgram(name());
}

void Program::set(std::string_view uniform, int value) {
    glUniform1i(locate(uniform), value);
}

void Program::set(std::string_view uniform, float value) {
    glUniform1f(locate(uniform), value);
}

void Program::set(std::string_view uniform, const glm::vec3& value) {
    glUniform3fv(locate(uniform), 1, &value.x);
}

void Program::set(std::string_view uniform, const glm::vec4& value) {
    glUniform4fv(locate(uniform), 1, &value.x);
}

void Program::set(std::string_view uniform, std::span<const glm::vec4> values) {
    if (!values.empty()) {
        glUniform4fv(locate(uniform), static_cast<GLsizei>(values.size()), &values.front().x);
    }
}

void Program::bindBlock(const char* block, unsigned index) const {
    const GLuint blockIndex = glGetUniformBlockIndex(name(), block);
    if (blockIndex != GL_INVALID_INDEX) {
        glUniformBlockBinding(name(), blockIndex, index);
    }
}

} // namespace posewire::render::gl
