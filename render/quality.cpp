// SPDX-License-Identifier: MIT
#include "render/renderer.h"

#include <algorithm>
#include <array>

namespace posewire::render {

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
    }
    return quality;
}

} // namespace posewire::render
