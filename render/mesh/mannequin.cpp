// SPDX-License-Identifier: MIT
#include "render/mesh/mannequin.h"

#include "render/mesh/mannequin_file.h"

#include "mannequin_bytes.h"

namespace posewire::render {
namespace {

std::string_view bytesOf(Detail detail) {
    switch (detail) {
    case Detail::Low:
        return embedded::mannequinLowGlb();
    case Detail::Medium:
        return embedded::mannequinMediumGlb();
    case Detail::High:
        break;
    }
    return embedded::mannequinGlb();
}

} // namespace

SkinnedMesh loadMannequin(Detail detail) {
    return readMannequinFile(bytesOf(detail)).value_or(SkinnedMesh{});
}

} // namespace posewire::render
