// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace posewire::test {

/// A datagram written down byte by byte from the specification, in tests/golden/<name>.hex.
struct Golden {
    std::string name;
    std::vector<std::byte> bytes;
};

/// All of them, by name.
[[nodiscard]] const std::vector<Golden>& goldens();
[[nodiscard]] const Golden& golden(const std::string& name);

/// The bytes of such a file anywhere.
[[nodiscard]] std::vector<std::byte> readHexadecimal(const std::filesystem::path& path);

/// A recorded datagram, "mxtp02.bin"; empty where the recordings are not at hand.
[[nodiscard]] std::vector<std::byte> capture(const std::string& file);

[[nodiscard]] std::vector<std::byte> readBytes(const std::filesystem::path& path);

} // namespace posewire::test
