// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace posewire::render {

/// The order of a pixel's four bytes in memory. Qt's Format_RGB32 is Bgra on little-endian machines,
/// its Format_RGBA8888 is Rgba.
enum class PixelOrder { Rgba, Bgra };

/// Rows from the top, four bytes per pixel, no padding.
struct Image {
    int width = 0;
    int height = 0;
    PixelOrder order = PixelOrder::Rgba;
    std::vector<std::uint8_t> pixels;

    std::size_t stride() const { return 4 * static_cast<std::size_t>(width); }
};

} // namespace posewire::render
