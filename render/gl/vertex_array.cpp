// SPDX-License-Identifier: MIT
#include "render/gl/vertex_array.h"

#include <epoxy/gl.h>

namespace posewire::render::gl {

VertexArray VertexArray::create() {
    unsigned name = 0;
    glGenVertexArrays(1, &name);
    VertexArray array;
    array.m_handle = Handle<deleteVertexArray>(name);
    return array;
}

void VertexArray::bind() const {
    glBindVertexArray(name());
}

void VertexArray::attach(const Buffer& buffer, std::size_t stride, const Attribute& attribute,
                         unsigned divisor) {
    bind();
    glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
    const void* offset = reinterpret_cast<const void*>(attribute.offset); // NOLINT: the API's own convention
    const auto step = static_cast<GLsizei>(stride);
    if (attribute.kind == Attribute::Kind::Float) {
        glVertexAttribPointer(attribute.location, attribute.components, GL_FLOAT, GL_FALSE, step, offset);
    } else {
        glVertexAttribIPointer(attribute.location, attribute.components, GL_UNSIGNED_BYTE, step, offset);
    }
    glEnableVertexAttribArray(attribute.location);
    glVertexAttribDivisor(attribute.location, divisor);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

void VertexArray::attachIndices(const Buffer& buffer) {
    bind();
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer.name());
}

} // namespace posewire::render::gl
