// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/body_meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace posewire::gui {
namespace {

class BodyMeshesTest : public testing::Test {
protected:
    /// A body of its own for each number.
    static render::NullPose body(int number) {
        render::NullPose pose = render::kReferenceNullPose;
        pose[render::Head].z += 0.0001F * static_cast<float>(number);
        return pose;
    }
    static bool isOf(const FigureMesh& mesh, int number) {
        return std::abs(mesh.origins[render::Head].z - body(number)[render::Head].z) < 1e-5F;
    }
    /// Asks for bodies in pictures until all that can be made are.
    void show(int first, int count) {
        for (int picture = 0; picture < 2 * count; ++picture) {
            m_meshes.beginPicture();
            for (int number = first; number < first + count; ++number) {
                EXPECT_NE(m_meshes.of(body(number)), nullptr);
            }
            if (!m_meshes.isBehind()) {
                return;
            }
        }
        FAIL() << "always behind";
    }

    BodyMeshes m_meshes{render::Detail::Medium};
};

TEST_F(BodyMeshesTest, FitsEachBodyOnceForAllWhoHaveIt) {
    m_meshes.beginPicture();
    const auto mesh = m_meshes.of(body(1));
    EXPECT_EQ(m_meshes.of(body(1)), mesh);
    EXPECT_NE(m_meshes.of(body(2)), mesh);
    m_meshes.beginPicture();
    EXPECT_EQ(m_meshes.of(body(1)), mesh);
    EXPECT_TRUE(isOf(*mesh, 1));
}

TEST_F(BodyMeshesTest, FitsAFewForEachPictureAndTheMannequinStandsIn) {
    std::set<const FigureMesh*> made;
    m_meshes.beginPicture();
    for (int number = 0; number < 10; ++number) {
        made.insert(m_meshes.of(body(number + 1)).get());
    }
    EXPECT_EQ(made.size(), BodyMeshes::kFitsAtOnce + 1U);
    EXPECT_TRUE(m_meshes.isBehind());
    show(1, 10);
    made.clear();
    m_meshes.beginPicture();
    for (int number = 0; number < 10; ++number) {
        made.insert(m_meshes.of(body(number + 1)).get());
    }
    EXPECT_EQ(made.size(), 10U);
}

TEST_F(BodyMeshesTest, KeepNoMoreHoweverManyAreShownOrHaveBeen) {
    show(1, 256);
    EXPECT_LE(m_meshes.memoryBytes(), m_meshes.mostBytes());
    EXPECT_FALSE(m_meshes.isBehind()) << "nothing more can be made";
    for (int number = 300; number < 400; ++number) {
        show(number, 1);
        EXPECT_TRUE(isOf(*m_meshes.of(body(number)), number)) << "what is shown now is made";
    }
    EXPECT_LE(m_meshes.memoryBytes(), m_meshes.mostBytes());
    EXPECT_LE(m_meshes.mostBytes(), std::size_t{400} << 20);
}

TEST_F(BodyMeshesTest, MakeABodyThatIsNoNumberOnce) {
    render::NullPose broken = body(1);
    broken[render::LeftHand].x = std::numeric_limits<float>::quiet_NaN();
    m_meshes.beginPicture();
    const auto mesh = m_meshes.of(broken);
    m_meshes.beginPicture();
    EXPECT_EQ(m_meshes.of(broken), mesh);
}

} // namespace
} // namespace posewire::gui
