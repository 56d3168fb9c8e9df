// SPDX-License-Identifier: MIT
#include "render/renderer.h"

#include <algorithm>
#include <array>

namespace posewire::render {
namespace {

/// Device pixels; in a body that is no taller the triangles of the low mesh are hardly to be seen.
constexpr float kSmallBody = 140.0F;
/// A larger picture with four samples a pixel takes the processor the better part of a second.
constexpr double kMostMultisampledPixels = 2.5e6;

} // namespace

bool isSoftwareRenderer(std::string_view rendererName) {
    static constexpr std::array<std::string_view, 4> kNames{"llvmpipe", "softpipe", "swrast",
                                                            "Software Rasterizer"};
    return std::ranges::any_of(
        kNames, [&](std::string_view name) { return rendererName.find(name) != std::string_view::npos; });
}

RenderQuality interactiveQuality(std::string_view rendererName) {
    RenderQuality quality;
    if (isSoftwareRenderer(rendererName)) {
        quality.samples = 0;
        quality.edgeSmoothing = true;
        quality.shadowMapSize = 1024;
        quality.floorShadowSize = 512;
        quality.charactersAtOnce = 16;
        quality.keepsBackdrop = true;
        quality.lowBodiesBelow = kSmallBody;
    }
    return quality;
}

RenderQuality stillQuality(const RenderQuality& interactive, int width, int height) {
    RenderQuality quality;
    quality.charactersAtOnce = interactive.charactersAtOnce;
    if (static_cast<double>(width) * height > kMostMultisampledPixels) {
        quality.samples = interactive.samples;
        quality.edgeSmoothing = interactive.edgeSmoothing;
    }
    return quality;
}

} // namespace posewire::render
