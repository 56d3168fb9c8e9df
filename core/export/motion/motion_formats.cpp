// SPDX-License-Identifier: MIT
#include "core/export/formats.h"
#include "core/export/motion/bvh.h"
#include "core/export/motion/c3d.h"
#include "core/export/motion/gltf.h"
#include "core/export/motion/motion_export.h"
#include "core/export/motion/mvnx.h"
#include "core/export/motion/tables.h"
#include "core/wire/text.h"

#include <algorithm>

namespace posewire::exporting {
namespace {

constexpr MotionFormat kFormats[] = {
    {"CSV", "Comma-separated values", "csv", "a row for each sample: position and quaternion of each segment",
     "a row without values", true, false, makeMotionCsv},
    {"JSON Lines", "JSON Lines", "jsonl", "an object for each sample, one on a line",
     "an object whose segments are null", true, false, makeMotionJsonLines},
    {"BVH", "Biovision hierarchy", "bvh", "body and fingers as a skeleton of constant bones, in centimetres",
     "the pose before it once more", false, false, makeBvh},
    {"glTF", "Binary glTF 2.0", "glb", "animated figures, with props", "bridged evenly", true, false,
     makeGlb},
    {"C3D", "C3D", "c3d", "markers where they were sent, else segment origins, in millimetres",
     "points without a measurement", false, true, makeC3d},
    {"MVNX", "MVN XML", "mvnx", "body, null pose and joint angles as XML of version 4", "a frame left out",
     false, false, makeMvnx},
};

} // namespace

std::span<const MotionFormat> motionFormats() {
    return kFormats;
}

const MotionFormat* findMotionFormat(std::string_view suffix) {
    const auto found = std::ranges::find(kFormats, wire::lowered(suffix),
                                         [](const MotionFormat& format) { return format.suffix; });
    return found == std::end(kFormats) ? nullptr : found;
}

const MotionFormat* motionFormatOf(std::string_view fileName) {
    const auto found = std::ranges::find_if(
        kFormats, [&](const MotionFormat& format) { return hasSuffix(fileName, format.suffix); });
    return found == std::end(kFormats) ? nullptr : found;
}

} // namespace posewire::exporting
