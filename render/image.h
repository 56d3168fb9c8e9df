// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <tl/expected.hpp>

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

tl::expected<void, std::string> writePng(const Image& image, const std::filesystem::path& path);
/// Always PixelOrder::Rgba; grey, palette and 16-bit pictures are converted.
tl::expected<Image, std::string> readPng(const std::filesystem::path& path);

/// How far two pictures are apart, over red, green and blue, in steps of 1/255.
struct ImageDifference {
    bool sameSize = false;
    int largest = 0;
    double mean = 0.0;
    /// Share of pixels with a channel that is off by more than the tolerance.
    double shareBeyond = 0.0;
};

ImageDifference compareImages(const Image& a, const Image& b, int tolerance);
/// Where they differ, strengthened so that one step shows; empty where the sizes disagree.
Image differenceImage(const Image& a, const Image& b);

} // namespace posewire::render
