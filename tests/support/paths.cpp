// SPDX-License-Identifier: MIT
#include "tests/support/paths.h"

namespace posewire::test {

std::filesystem::path sourcePath(const std::filesystem::path& relative) {
    return std::filesystem::path(POSEWIRE_SOURCE_DIR) / relative;
}

std::filesystem::path capturesFolder() {
    return sourcePath("../shared/captures");
}

} // namespace posewire::test
