// SPDX-License-Identifier: MIT
#include "tests/support/golden.h"
#include "tests/support/paths.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

namespace posewire::test {
namespace {

std::vector<Golden> readGoldens() {
    std::vector<Golden> all;
    for (const auto& entry : std::filesystem::directory_iterator(sourcePath("tests/golden"))) {
        if (entry.path().extension() == ".hex") {
            all.push_back({entry.path().stem().string(), readHexadecimal(entry.path())});
        }
    }
    std::sort(all.begin(), all.end(), [](const Golden& a, const Golden& b) { return a.name < b.name; });
    return all;
}

} // namespace

std::vector<std::byte> readHexadecimal(const std::filesystem::path& path) {
    std::vector<std::byte> bytes;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line.substr(0, line.find('#')));
        for (std::string word; words >> word;) {
            bytes.push_back(static_cast<std::byte>(std::stoi(word, nullptr, 16)));
        }
    }
    return bytes;
}

const std::vector<Golden>& goldens() {
    static const std::vector<Golden> all = readGoldens();
    return all;
}

const Golden& golden(const std::string& name) {
    static const Golden none;
    const auto found =
        std::find_if(goldens().begin(), goldens().end(), [&](const Golden& g) { return g.name == name; });
    return found == goldens().end() ? none : *found;
}

std::vector<std::byte> readBytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    std::vector<std::byte> bytes(text.size());
    std::transform(text.begin(), text.end(), bytes.begin(), [](char c) { return static_cast<std::byte>(c); });
    return bytes;
}

std::vector<std::byte> capture(const std::string& file) {
    return readBytes(capturesFolder() / file);
}

} // namespace posewire::test
