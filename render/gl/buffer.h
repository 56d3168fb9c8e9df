// SPDX-License-Identifier: MIT
#pragma once

#include "render/gl/handle.h"

#include <cstddef>
#include <span>

namespace posewire::render::gl {

/// A buffer object. Uploading replaces the whole content and lets the driver keep the old one for what is
/// still being drawn.
class Buffer {
public:
    enum class Usage { Static, Stream };

    static Buffer create();

    unsigned name() const { return m_handle.name(); }
    std::size_t size() const { return m_size; }

    void upload(std::span<const std::byte> bytes, Usage usage);
    template <typename T>
    void upload(std::span<const T> values, Usage usage) {
        upload(std::as_bytes(values), usage);
    }
    /// Writes over the beginning, in the room there is where it is enough: for a buffer that nothing under
    /// way reads any more.
    void write(std::span<const std::byte> bytes, Usage usage);
    /// Room without content.
    void allocate(std::size_t size, Usage usage);
    void read(std::span<std::byte> bytes) const;

    void bindUniform(unsigned index) const;
    void bindTransformFeedback(unsigned index) const;

private:
    Handle<deleteBuffer> m_handle;
    std::size_t m_size = 0;
};

} // namespace posewire::render::gl
