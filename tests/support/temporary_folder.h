// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <random>
#include <string>

namespace posewire::test {

/// A new folder of its own: every test is a process, and they run side by side.
inline std::filesystem::path newTemporaryFolder(const std::string& name) {
    static std::random_device random;
    const auto folder = std::filesystem::temp_directory_path() /
                        ("posewire_" + name + '_' + std::to_string(random()) + std::to_string(random()));
    std::filesystem::create_directories(folder);
    return folder;
}

} // namespace posewire::test
