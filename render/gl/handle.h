// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

namespace posewire::render::gl {

/// Owns the name of an OpenGL object; 0 owns nothing. Every object of gl/ has to be destroyed with its
/// context (or one that shares with it) current.
template <void (*destroy)(unsigned)>
class Handle {
public:
    Handle() = default;
    explicit Handle(unsigned name) : m_name(name) {}
    Handle(Handle&& other) noexcept : m_name(std::exchange(other.m_name, 0U)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(m_name, other.m_name);
        return *this;
    }
    ~Handle() {
        if (m_name != 0) {
            destroy(m_name);
        }
    }

    unsigned name() const { return m_name; }

private:
    unsigned m_name = 0;
};

void deleteBuffer(unsigned name);
void deleteVertexArray(unsigned name);
void deleteShader(unsigned name);
void deleteProgram(unsigned name);
void deleteTexture(unsigned name);
void deleteFramebuffer(unsigned name);
void deleteRenderbuffer(unsigned name);
void deleteSampler(unsigned name);

} // namespace posewire::render::gl
