// SPDX-License-Identifier: MIT
#include "render/gl/buffer.h"

#include <epoxy/gl.h>

namespace posewire::render::gl {
namespace {

GLenum hint(Buffer::Usage usage) {
    return usage == Buffer::Usage::Static ? GL_STATIC_DRAW : GL_STREAM_DRAW;
}

} // namespace

Buffer Buffer::create() {
    unsigned name = 0;
    glGenBuffers(1, &name);
    Buffer buffer;
    buffer.m_handle = Handle<deleteBuffer>(name);
    return buffer;
}

// GL_COPY_WRITE_BUFFER is no part of any vertex array's state, so that no other object is disturbed.
void Buffer::upload(std::span<const std::byte> bytes, Usage usage) {
    glBindBuffer(GL_COPY_WRITE_BUFFER, name());
    glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), hint(usage));
    m_size = bytes.size();
}

void Buffer::write(std::span<const std::byte> bytes, Usage usage) {
    if (bytes.size() > m_size) {
        return upload(bytes, usage);
    }
    glBindBuffer(GL_COPY_WRITE_BUFFER, name());
    glBufferSubData(GL_COPY_WRITE_BUFFER, 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

void Buffer::allocate(std::size_t size, Usage usage) {
    glBindBuffer(GL_COPY_WRITE_BUFFER, name());
    glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(size), nullptr, hint(usage));
    m_size = size;
}

void Buffer::read(std::span<std::byte> bytes) const {
    glBindBuffer(GL_COPY_READ_BUFFER, name());
    glGetBufferSubData(GL_COPY_READ_BUFFER, 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

void Buffer::bindUniform(unsigned index) const {
    glBindBufferBase(GL_UNIFORM_BUFFER, index, name());
}

void Buffer::bindTransformFeedback(unsigned index) const {
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, index, name());
}

} // namespace posewire::render::gl
