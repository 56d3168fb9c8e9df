// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

/// Names of files are UTF-8 in every text of ours. A path of the library takes and gives them in what the
/// system prefers, which on Windows loses letters: so never by std::string.
namespace posewire::log {

[[nodiscard]] inline std::filesystem::path pathOf(std::string_view name) {
    return std::u8string_view(reinterpret_cast<const char8_t*>(name.data()), name.size());
}

[[nodiscard]] inline std::string nameOf(const std::filesystem::path& path) {
    const std::u8string name = path.u8string();
    return {reinterpret_cast<const char*>(name.data()), name.size()};
}

} // namespace posewire::log
