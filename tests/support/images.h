// SPDX-License-Identifier: MIT
#pragma once

#include "render/image.h"

#include <filesystem>
#include <string>

#include <tl/expected.hpp>

namespace posewire::render::test {

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

} // namespace posewire::render::test
