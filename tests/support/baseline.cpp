// SPDX-License-Identifier: MIT
#include "tests/support/baseline.h"

#include "tests/support/images.h"

#include <cstdlib>
#include <filesystem>
#include <string_view>

#include <gtest/gtest.h>

namespace posewire::render::test {
namespace {

constexpr int kTolerance = 2;
constexpr double kShareAllowed = 0.0005;

std::filesystem::path baselinePath(const std::string& name) {
    return std::filesystem::path(POSEWIRE_BASELINE_DIR) / (name + ".png");
}

std::filesystem::path picturePath(const std::string& name) {
    const std::filesystem::path folder(POSEWIRE_PICTURE_DIR);
    std::filesystem::create_directories(folder);
    return folder / name;
}

bool isUpdating() {
    const char* value = std::getenv("POSEWIRE_UPDATE_BASELINES");
    return value != nullptr && std::string_view(value) == "1";
}

std::string saved(const Image& image, const std::string& name) {
    const std::filesystem::path path = picturePath(name);
    const auto written = writePng(image, path);
    return written ? path.string() : written.error();
}

} // namespace

void expectMatchesBaseline(const Image& image, const std::string& name) {
    if (isUpdating()) {
        const auto written = writePng(image, baselinePath(name));
        EXPECT_TRUE(written.has_value()) << written.error();
        return;
    }
    const auto baseline = readPng(baselinePath(name));
    if (!baseline) {
        ADD_FAILURE() << "no baseline: " << baseline.error() << "; the picture is "
                      << saved(image, name + ".actual.png");
        return;
    }
    const ImageDifference difference = compareImages(image, *baseline, kTolerance);
    if (!difference.sameSize) {
        ADD_FAILURE() << name << " is " << image.width << " x " << image.height << ", its baseline "
                      << baseline->width << " x " << baseline->height << "; the picture is "
                      << saved(image, name + ".actual.png");
    } else if (difference.shareBeyond > kShareAllowed) {
        ADD_FAILURE() << name << ": " << 100.0 * difference.shareBeyond
                      << " % of the pixels are off by more than " << kTolerance << "/255 (at most "
                      << difference.largest << ", mean " << difference.mean << "); see "
                      << saved(image, name + ".actual.png") << " and "
                      << saved(differenceImage(image, *baseline), name + ".diff.png");
    }
}

void useSoftwareOpenGl() {
#ifndef _WIN32 // there the packaging's scripts say it
    setenv("LP_NATIVE_VECTOR_WIDTH", "256", 0);
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 0);
#endif
}

} // namespace posewire::render::test
