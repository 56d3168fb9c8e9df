// SPDX-License-Identifier: MIT
#include "render/mesh/generator/glb_writer.h"
#include "render/mesh/joints.h"
#include "render/mesh/mannequin.h"
#include "render/mesh/mannequin_file.h"

#include <gtest/gtest.h>

namespace posewire::render {
namespace {

const std::string& lowFile() {
    static const std::string bytes = mannequin::glbOf(loadMannequin(Detail::Low));
    return bytes;
}

TEST(MannequinFile, ReadsBackWhatWasWritten) {
    const SkinnedMesh mesh = loadMannequin(Detail::Low);
    const auto read = readMannequinFile(lowFile());
    ASSERT_TRUE(read) << read.error();
    EXPECT_EQ(read->positions, mesh.positions);
    EXPECT_EQ(read->normals, mesh.normals);
    EXPECT_EQ(read->weights, mesh.weights);
    EXPECT_EQ(read->joints, mesh.joints);
    EXPECT_EQ(read->occlusion, mesh.occlusion);
    EXPECT_EQ(read->indices, mesh.indices);
}

TEST(MannequinFile, StatesItsLengthAndIsPaddedToWords) {
    const std::string& bytes = lowFile();
    std::uint32_t length = 0;
    std::copy_n(bytes.data() + 8, 4, reinterpret_cast<char*>(&length));
    EXPECT_EQ(length, bytes.size());
    EXPECT_EQ(bytes.size() % 4, 0U);
}

TEST(MannequinFile, RefusesEveryCutWithAReason) {
    const std::string& bytes = lowFile();
    for (std::size_t size = 0; size < bytes.size(); size += size < 64 ? 1 : 997) {
        const auto read = readMannequinFile(std::string_view(bytes).substr(0, size));
        ASSERT_FALSE(read) << size;
        EXPECT_FALSE(read.error().empty());
    }
}

TEST(MannequinFile, RefusesOtherBinaryGltf) {
    std::string bytes = lowFile();
    bytes.replace(bytes.find("PWMN"), 4, "XXXX");
    const auto read = readMannequinFile(bytes);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error(), "this glTF file is not a mannequin of this version");
}

TEST(MannequinFile, RefusesCountsBeyondTheFile) {
    std::string bytes = lowFile();
    const std::size_t header = bytes.find("PWMN");
    bytes.replace(header + 8, 8, 8, '\xFF');
    EXPECT_FALSE(readMannequinFile(bytes));
}

TEST(MannequinFile, RefusesIndicesOutOfRange) {
    std::string bytes = lowFile();
    const SkinnedMesh mesh = loadMannequin(Detail::Low);
    const auto layout = MannequinFileLayout::of(mesh.vertexCount(), mesh.indices.size());
    bytes.replace(bytes.find("PWMN") + layout.indices, 2, 2, '\xFF');
    EXPECT_FALSE(readMannequinFile(bytes));
}

} // namespace
} // namespace posewire::render
