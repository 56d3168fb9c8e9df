// SPDX-License-Identifier: MIT
#include "tests/support/images.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include <png.h>

namespace posewire::render::test {
namespace {

/// Where red, green and blue are in a pixel.
std::array<std::size_t, 3> channels(PixelOrder order) {
    return order == PixelOrder::Rgba ? std::array<std::size_t, 3>{0, 1, 2}
                                     : std::array<std::size_t, 3>{2, 1, 0};
}

png_image describe(const Image& image) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = static_cast<png_uint_32>(image.width);
    png.height = static_cast<png_uint_32>(image.height);
    png.format = image.order == PixelOrder::Rgba ? PNG_FORMAT_RGBA : PNG_FORMAT_BGRA;
    return png;
}

bool isComplete(const Image& image) {
    return image.width > 0 && image.height > 0 &&
           image.pixels.size() == image.stride() * static_cast<std::size_t>(image.height);
}

/// Calls `visit(pixel, channel, difference)` for every colour value of two pictures of one size.
template <typename Visit>
void forEachDifference(const Image& a, const Image& b, Visit visit) {
    const auto inA = channels(a.order);
    const auto inB = channels(b.order);
    for (std::size_t offset = 0; offset + 3 < a.pixels.size(); offset += 4) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            visit(offset, channel,
                  std::abs(a.pixels[offset + inA[channel]] - b.pixels[offset + inB[channel]]));
        }
    }
}

bool sameSize(const Image& a, const Image& b) {
    return a.width == b.width && a.height == b.height && a.pixels.size() == b.pixels.size();
}

} // namespace

tl::expected<void, std::string> writePng(const Image& image, const std::filesystem::path& path) {
    if (!isComplete(image)) {
        return tl::unexpected(path.string() + ": the picture has no pixels");
    }
    png_image png = describe(image);
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
    std::vector<char> bytes(size);
    if (png_image_write_to_memory(&png, bytes.data(), &size, 0, image.pixels.data(), 0, nullptr) == 0) {
        return tl::unexpected(path.string() + ": " + png.message);
    }
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file.write(bytes.data(), static_cast<std::streamsize>(size));
    file.close();
    if (!file) {
        return tl::unexpected(path.string() + ": cannot be written");
    }
    return {};
}

tl::expected<Image, std::string> readPng(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        return tl::unexpected(path.string() + ": cannot be opened");
    }
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) {
        return tl::unexpected(path.string() + ": " + png.message);
    }
    png.format = PNG_FORMAT_RGBA;
    Image image;
    image.width = static_cast<int>(png.width);
    image.height = static_cast<int>(png.height);
    image.pixels.resize(PNG_IMAGE_SIZE(png));
    if (png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr) == 0) {
        return tl::unexpected(path.string() + ": " + png.message);
    }
    return image;
}

ImageDifference compareImages(const Image& a, const Image& b, int tolerance) {
    ImageDifference result;
    result.sameSize = sameSize(a, b);
    if (!result.sameSize || a.pixels.empty()) {
        return result;
    }
    std::size_t beyond = 0;
    std::size_t lastBeyond = a.pixels.size();
    double sum = 0.0;
    forEachDifference(a, b, [&](std::size_t pixel, std::size_t, int difference) {
        result.largest = std::max(result.largest, difference);
        sum += difference;
        if (difference > tolerance && lastBeyond != pixel) {
            lastBeyond = pixel;
            ++beyond;
        }
    });
    const double pixels = static_cast<double>(a.pixels.size()) / 4.0;
    result.mean = sum / (3.0 * pixels);
    result.shareBeyond = static_cast<double>(beyond) / pixels;
    return result;
}

Image differenceImage(const Image& a, const Image& b) {
    Image result;
    if (!sameSize(a, b)) {
        return result;
    }
    result.width = a.width;
    result.height = a.height;
    result.pixels.assign(a.pixels.size(), 255);
    forEachDifference(a, b, [&](std::size_t pixel, std::size_t channel, int difference) {
        result.pixels[pixel + channel] = static_cast<std::uint8_t>(std::min(16 * difference, 255));
    });
    return result;
}

} // namespace posewire::render::test
