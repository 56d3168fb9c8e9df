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
    {.title = "CSV",
     .kind = "Comma-separated values",
     .suffix = "csv",
     .holds = "a row for each sample, with position and quaternion of each segment",
     .gaps = "a row without values",
     .holdsSeveral = true,
     .hasTimes = true,
     .make = makeMotionCsv},
    {.title = "JSON Lines",
     .kind = "JSON Lines",
     .suffix = "jsonl",
     .holds = "an object for each sample, one on a line",
     .gaps = "an object whose segments are null",
     .holdsSeveral = true,
     .hasTimes = true,
     .make = makeMotionJsonLines},
    {.title = "BVH",
     .kind = "Biovision hierarchy",
     .suffix = "bvh",
     .holds = "body and fingers as a skeleton of constant bones, in centimetres",
     .gaps = "the pose before it once more",
     .make = makeBvh},
    {.title = "glTF",
     .kind = "Binary glTF 2.0",
     .suffix = "glb",
     .holds = "animated figures, with props",
     .gaps = "bridged evenly",
     .holdsSeveral = true,
     .hasTimes = true,
     .make = makeGlb},
    {.title = "C3D",
     .kind = "C3D",
     .suffix = "c3d",
     .holds = "markers where they were sent, else segment origins, in millimetres",
     .gaps = "points without a measurement",
     .takesMarkers = true,
     .make = makeC3d},
    {.title = "MVNX",
     .kind = "MVN XML",
     .suffix = "mvnx",
     .holds = "body, null pose and joint angles as XML of version 4",
     .gaps = "a frame left out",
     .hasTimes = true,
     .make = makeMvnx},
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
