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
                         unsigned divisor) const {
    bind();
    glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
    const void* offset = reinterpret_cast<const void*>(attribute.offset); // NOLINT: the API's own convention
    const auto step = static_cast<GLsizei>(stride);
    const auto pointer = [&](GLenum type, GLboolean isShare) {
        glVertexAttribPointer(attribute.location, attribute.components, type, isShare, step, offset);
    };
    switch (attribute.kind) {
    case Attribute::Kind::Float:
        pointer(GL_FLOAT, GL_FALSE);
        break;
    case Attribute::Kind::UnsignedShare:
        pointer(GL_UNSIGNED_SHORT, GL_TRUE);
        break;
    case Attribute::Kind::SignedShare:
        pointer(GL_SHORT, GL_TRUE);
        break;
    case Attribute::Kind::Integer:
        glVertexAttribIPointer(attribute.location, attribute.components, GL_INT, step, offset);
        break;
    case Attribute::Kind::ByteInteger:
        glVertexAttribIPointer(attribute.location, attribute.components, GL_UNSIGNED_BYTE, step, offset);
        break;
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
