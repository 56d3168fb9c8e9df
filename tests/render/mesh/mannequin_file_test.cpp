// SPDX-License-Identifier: MIT
#include "render/mesh/mannequin_file.h"

#include "render/mesh/mannequin.h"
#include "tests/support/paths.h"

#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

namespace posewire::render {
namespace {

std::string committedFile() {
    std::ifstream file(posewire::test::sourcePath("resources/mannequin_medium.glb"), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(MannequinFile, RefusesEveryCutWithAReason) {
    const std::string bytes = committedFile();
    for (std::size_t size = 0; size < bytes.size(); size += size < 64 ? 1 : 997) {
        const auto read = readMannequinFile(std::string_view(bytes).substr(0, size));
        ASSERT_FALSE(read) << size;
        EXPECT_FALSE(read.error().empty());
    }
}

TEST(MannequinFile, RefusesOtherBinaryGltf) {
    std::string bytes = committedFile();
    bytes.replace(bytes.find("PWMN"), 4, "XXXX");
    const auto read = readMannequinFile(bytes);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error(), "this glTF file is not a mannequin of this version");
}

TEST(MannequinFile, RefusesCountsBeyondTheFile) {
    std::string bytes = committedFile();
    const std::size_t header = bytes.find("PWMN");
    bytes.replace(header + 8, 8, 8, '\xFF');
    EXPECT_FALSE(readMannequinFile(bytes));
}

TEST(MannequinFile, RefusesIndicesOutOfRange) {
    std::string bytes = committedFile();
    const SkinnedMesh mesh = loadMannequin(Detail::Medium);
    const auto layout = MannequinFileLayout::of(mesh.vertexCount(), mesh.indices.size());
    bytes.replace(bytes.find("PWMN") + layout.indices, 2, 2, '\xFF');
    EXPECT_FALSE(readMannequinFile(bytes));
}

TEST(MannequinFile, RefusesAnotherVersion) {
    std::string bytes = committedFile();
    bytes[bytes.find("PWMN") + 4] = '\x7F';
    EXPECT_EQ(readMannequinFile(bytes).error(), "this glTF file is not a mannequin of this version");
}

TEST(MannequinFile, RefusesAFileWithoutABinaryChunk) {
    std::string bytes = committedFile();
    bytes.replace(bytes.find(std::string("BIN\0", 4)), 3, "BIX");
    EXPECT_EQ(readMannequinFile(bytes).error(), "this is no binary glTF file");
    EXPECT_FALSE(readMannequinFile("glTF is mentioned here, and that is all"));
    EXPECT_FALSE(readMannequinFile("{\"asset\": {\"version\": \"2.0\"}}"));
}

TEST(MannequinFile, RefusesWeightsThatDoNotSumToOne) {
    std::string bytes = committedFile();
    const SkinnedMesh mesh = loadMannequin(Detail::Medium);
    const auto layout = MannequinFileLayout::of(mesh.vertexCount(), mesh.indices.size());
    bytes.replace(bytes.find("PWMN") + layout.weights, 4, 4, '\0');
    EXPECT_EQ(readMannequinFile(bytes).error(), "the weights of vertex 0 do not sum to 1");
}

} // namespace
} // namespace posewire::render
