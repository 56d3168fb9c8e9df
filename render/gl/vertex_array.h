// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/buffer.h"

#include <cstddef>

namespace posewire::render::gl {

/// One attribute in a buffer of structs.
struct Attribute {
    enum class Kind {
        Float,         ///< 32-bit floats
        ByteInteger,   ///< unsigned bytes that stay integers
        Integer,       ///< 32-bit integers that stay so
        UnsignedShare, ///< 16 bits: 0 … 1
        SignedShare    ///< 16 bits: −1 … 1
    };
    unsigned location = 0;
    int components = 4;
    std::size_t offset = 0;
    Kind kind = Kind::Float;
};

/// Where vertices come from.
class VertexArray {
public:
    static VertexArray create();

    unsigned name() const { return m_handle.name(); }
    void bind() const;
    /// `divisor` 1 reads one struct per instance.
    void attach(const Buffer& buffer, std::size_t stride, const Attribute& attribute,
                unsigned divisor = 0) const;
    void attachIndices(const Buffer& buffer);

private:
    Handle<deleteVertexArray> m_handle;
};

} // namespace posewire::render::gl
