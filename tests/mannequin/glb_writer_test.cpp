// SPDX-License-Identifier: MIT
#include "packaging/mannequin/glb_writer.h"

#include "render/mesh/mannequin.h"
#include "render/mesh/mannequin_file.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace posewire::render {
namespace {

TEST(GlbWriter, ReadsBackWhatWasWritten) {
    const SkinnedMesh mesh = loadMannequin(Detail::Medium);
    const auto read = readMannequinFile(mannequin::glbOf(mesh));
    ASSERT_TRUE(read) << read.error();
    EXPECT_EQ(read->positions, mesh.positions);
    EXPECT_EQ(read->normals, mesh.normals);
    EXPECT_EQ(read->weights, mesh.weights);
    EXPECT_EQ(read->joints, mesh.joints);
    EXPECT_EQ(read->occlusion, mesh.occlusion);
    EXPECT_EQ(read->indices, mesh.indices);
}

TEST(GlbWriter, StatesItsLengthAndIsPaddedToWords) {
    const std::string bytes = mannequin::glbOf(loadMannequin(Detail::Medium));
    std::uint32_t length = 0;
    std::copy_n(bytes.data() + 8, 4, reinterpret_cast<char*>(&length));
    EXPECT_EQ(length, bytes.size());
    EXPECT_EQ(bytes.size() % 4, 0U);
}

} // namespace
} // namespace posewire::render
