// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace posewire::test {

/// A file or folder of the source tree; `relative` as in "tests/golden".
[[nodiscard]] std::filesystem::path sourcePath(const std::filesystem::path& relative);

/// The recorded datagrams beside the source tree; they need not be there.
[[nodiscard]] std::filesystem::path capturesFolder();

} // namespace posewire::test
