// SPDX-License-Identifier: MIT
#include "tests/core/export/motion/imported_motion.h"
#include "tests/core/export/motion/motion_fixture.h"
#include "tests/support/hostile_text.h"

#include <numbers>

namespace posewire::exporting {
namespace {

using Eigen::Vector3d;

constexpr double kMillimetre = 1e-3;

/// From the frame of the files.
Vector3d zUp(const Vector3d& yUp, double unit) {
    return model::zUpFromYUp(Vector3d(yUp * unit));
}

double angleBetween(const Eigen::Affine3d& yUp, const Eigen::Quaterniond& turn) {
    return Eigen::Quaterniond(yUp.rotation()).angularDistance(model::yUpFromZUp(turn));
}

class BvhTest : public MotionTest {
protected:
    /// Greatest distance of a joint from where its segment was sent, over all frames; frame n shows the
    /// sample shown(n).
    [[nodiscard]] double greatestError(const std::string& path, std::uint8_t character, unsigned frames,
                                       const std::function<std::uint32_t(unsigned)>& shown) const {
        const ImportedMotion motion(path);
        EXPECT_NE(motion.animation(), nullptr) << motion.problem();
        double worst = 0;
        for (unsigned frame = 0; motion.animation() != nullptr && frame < frames; ++frame) {
            const auto& poses = sent(character, shown(frame));
            for (std::size_t i = 0; i < model::bodySegments().size(); ++i) {
                const aiNode* node = motion.node(std::string(model::bodySegments()[i].name));
                EXPECT_NE(node, nullptr);
                const Eigen::Affine3d world = motion.worldOf(node, frame);
                worst = std::max(worst, (zUp(world.translation(), 0.01) - poses[i].position).norm());
                EXPECT_LT(angleBetween(world, poses[i].orientation), 1e-3);
            }
        }
        return worst;
    }
    static std::uint32_t next(unsigned frame) { return frame + 1; }
    /// Over and over, through the poles of its angles.
    static Eigen::Quaterniond turnAt(unsigned frame) {
        return Eigen::AngleAxisd(frame * std::numbers::pi / 16, Vector3d::UnitY()) *
               Eigen::AngleAxisd(frame * 0.1, Vector3d::UnitX());
    }
};

/// Bones of BVH have one length, and so have those of the performer.
TEST_F(BvhTest, PutsJointsWhereSegmentsWereSent) {
    perform(settings(), 180);
    static_cast<void>(written("bvh", source()));
    EXPECT_LT(greatestError(path("take.bvh"), 0, 180, next), kMillimetre);
}

TEST_F(BvhTest, MakesItsBonesOfThePoseWhereNoNullPoseCame) {
    perform(settings(), 60, [](const wire::Datagram& datagram) { return datagram.header.type() != 13; });
    static_cast<void>(written("bvh", source()));
    EXPECT_LT(greatestError(path("take.bvh"), 0, 60, next), kMillimetre);
}

TEST_F(BvhTest, RepeatsThePoseBeforeAGap) {
    perform(settings(), 60, without({20, 21}));
    static_cast<void>(written("bvh", source()));
    const ImportedMotion motion(path("take.bvh"));
    ASSERT_NE(motion.animation(), nullptr);
    EXPECT_EQ(motion.animation()->mDuration, 59);
    EXPECT_NEAR(motion.animation()->mTicksPerSecond, 60, 1e-3);
    EXPECT_LT(greatestError(path("take.bvh"), 0, 60,
                            [](unsigned frame) { return frame == 19 || frame == 20 ? 19U : frame + 1; }),
              kMillimetre);
}

TEST_F(BvhTest, HoldsOneCharacterWithItsFingers) {
    auto two = settings(2);
    two.fingers = true;
    two.props = 1;
    perform(two, 20);
    const feed::PoseSource both = source();
    const auto exported = write("bvh", both);
    ASSERT_TRUE(exported);
    ASSERT_EQ(exported->size(), 2U);
    for (const ExportedMotion& one : *exported) {
        const std::uint8_t id = both.characters[one.character].key.character;
        EXPECT_LT(greatestError(one.path, id, 20, next), kMillimetre);
        const ImportedMotion motion(one.path);
        const model::SegmentLayout layout{23, 1, 40};
        for (int position = 24; position < layout.count(); ++position) {
            const aiNode* node = motion.node(std::string(model::segmentName(layout, position)));
            ASSERT_NE(node, nullptr);
            const auto& segment = sent(id, 20)[static_cast<std::size_t>(position)];
            EXPECT_LT((zUp(motion.worldOf(node, 19).translation(), 0.01) - segment.position).norm(),
                      kMillimetre);
        }
        EXPECT_EQ(motion.node("Prop1"), nullptr);
    }
}

TEST_F(BvhTest, KeepsAnglesThroughAnyTurn) {
    performer::Performer performer(settings());
    for (std::uint32_t frame = 0; frame < 64; ++frame) {
        for (wire::Datagram datagram : performer.frame(frame)) {
            auto* message = std::get_if<wire::PoseQuaternion>(&datagram.body);
            if (message != nullptr) {
                const Eigen::Quaterniond turn = turnAt(frame);
                message->segments[0].orientation = model::toFloats(turn);
            }
            send(datagram, kStart + frame * 16ms);
        }
    }
    follow();
    static_cast<void>(written("bvh", source()));
    const ImportedMotion motion(path("take.bvh"));
    ASSERT_NE(motion.animation(), nullptr);
    for (unsigned frame = 0; frame < 64; ++frame) {
        const Eigen::Quaterniond turn = turnAt(frame);
        EXPECT_LT(angleBetween(motion.worldOf(motion.node("Pelvis"), frame), turn), 1e-3) << frame;
    }
}

class GlbTest : public MotionTest {
protected:
    /// A triangle for each segment that has an origin, at that; and one more joint that moves none, a metre
    /// above the head and turned against it.
    static BodyMesh triangles(const SegmentPlaces& places) {
        BodyMesh mesh;
        for (std::size_t slot = 0; slot < places.size(); ++slot) {
            if (!places[slot].allFinite()) {
                continue;
            }
            for (const Vector3d& corner : {Vector3d(0, 0, 0), Vector3d(0.1, 0, 0), Vector3d(0, 0.1, 0)}) {
                mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
                mesh.positions.push_back(model::toFloats(Vector3d(places[slot] + corner)));
                mesh.normals.push_back({0, 0, 1});
                mesh.joints.push_back({static_cast<std::uint8_t>(mesh.skeleton.size()), 0, 0, 0});
                mesh.weights.push_back({1, 0, 0, 0});
            }
            mesh.skeleton.push_back({"", static_cast<int>(slot), places[slot], false});
        }
        mesh.skeleton.push_back({"Head halo", kHead, places[kHead], true});
        mesh.pose = [](std::span<const model::SegmentPose> segments, std::span<model::SegmentPose> joints) {
            joints.back() = haloOf(segments[kHead]);
        };
        return mesh;
    }
    static model::SegmentPose haloOf(const model::SegmentPose& head) {
        return {head.position + Vector3d::UnitZ(),
                head.orientation * Eigen::AngleAxisd(0.5, Vector3d::UnitY())};
    }
    static constexpr int kHead = model::segment::kHead;
    void writeWithBodies(const feed::PoseSource& from) const {
        const auto exported =
            exportMotion({from, *findMotionFormat("glb"), path("take.glb"), {}, "Test", triangles});
        ASSERT_TRUE(exported) << exported.error().text;
    }
    /// assimp makes names differ where several nodes have one: "Pelvis" of the second character is found
    /// below its own node.
    [[nodiscard]] static std::string nameOf(std::size_t segment) {
        return std::string(model::bodySegments()[segment].name);
    }
};

TEST_F(GlbTest, PutsJointsExactlyWhereSegmentsWereSent) {
    auto whole = settings();
    whole.props = 2;
    whole.fingers = true;
    perform(whole, 120);
    static_cast<void>(written("glb", source()));
    const ImportedMotion motion(path("take.glb"));
    ASSERT_NE(motion.animation(), nullptr) << motion.problem();
    const model::SegmentLayout layout{23, 2, 40};
    EXPECT_EQ(motion.animation()->mNumChannels, static_cast<unsigned>(layout.count()));
    for (unsigned frame = 0; frame < 120; frame += 7) {
        const auto& poses = sent(0, frame + 1);
        for (int i = 0; i < layout.count(); ++i) {
            const aiNode* node = motion.node(std::string(model::segmentName(layout, i)));
            ASSERT_NE(node, nullptr);
            const auto& pose = poses[static_cast<std::size_t>(i)];
            const Eigen::Affine3d world = motion.worldOf(node, frame);
            EXPECT_LT((zUp(world.translation(), 1) - pose.position).norm(), 1e-5);
            EXPECT_LT(angleBetween(world, pose.orientation), 1e-3);
        }
    }
}

TEST_F(GlbTest, HasNoKeysInGapsAndKeepsTime) {
    perform(settings(), 200, without({50, 51}));
    perform(settings(), 20, sendsAll, kStart + 6s);
    static_cast<void>(written("glb", source()));
    const ImportedMotion motion(path("take.glb"));
    ASSERT_NE(motion.animation(), nullptr) << motion.problem();
    const aiNodeAnim* channel = motion.channelOf(*motion.node("Head"));
    ASSERT_EQ(channel->mNumRotationKeys, 218U);
    const double tick = 1 / motion.animation()->mTicksPerSecond;
    EXPECT_NEAR(channel->mRotationKeys[48].mTime * tick, 48 / 60.0, 1e-4);
    EXPECT_NEAR(channel->mRotationKeys[49].mTime * tick, 51 / 60.0, 1e-4);
    EXPECT_NEAR(channel->mRotationKeys[198].mTime * tick, 6.0, 1e-3);
}

TEST_F(GlbTest, SkinsEachBodyToItsOwnJoints) {
    auto whole = settings();
    whole.props = 1;
    whole.fingers = true;
    perform(whole, 30);
    writeWithBodies(source());
    const ImportedMotion motion(path("take.glb"));
    ASSERT_NE(motion.animation(), nullptr) << motion.problem();
    ASSERT_EQ(motion.scene()->mNumMeshes, 1U);
    const aiMesh& mesh = *motion.scene()->mMeshes[0];
    EXPECT_EQ(mesh.mNumVertices, 3U * 63);
    ASSERT_EQ(mesh.mNumBones, 64U);
    const model::SegmentLayout layout{23, 1, 40};
    for (unsigned bone = 0; bone + 1 < mesh.mNumBones; ++bone) {
        const aiBone& one = *mesh.mBones[bone];
        const int position =
            static_cast<int>(bone) < 23 ? static_cast<int>(bone) : static_cast<int>(bone) + 1;
        ASSERT_EQ(one.mName.C_Str(), std::string(model::segmentName(layout, position)));
        const aiMatrix4x4& m = one.mOffsetMatrix;
        Eigen::Affine3d bind;
        bind.matrix() << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2,
            m.d3, m.d4;
        const aiVector3D& corner = mesh.mVertices[3 * bone]; // at the segment's origin
        const Vector3d drawn = motion.worldOf(motion.node(one.mName.C_Str()), 17) * bind *
                               Vector3d(corner.x, corner.y, corner.z);
        EXPECT_LT((zUp(drawn, 1) - sent(0, 18)[static_cast<std::size_t>(position)].position).norm(), 1e-4);
    }
}

TEST_F(GlbTest, PosesJointsThatNoSegmentIs) {
    perform(settings(), 30);
    writeWithBodies(source());
    const ImportedMotion motion(path("take.glb"));
    ASSERT_NE(motion.animation(), nullptr) << motion.problem();
    const aiNode* halo = motion.node("Head halo");
    ASSERT_NE(halo, nullptr);
    EXPECT_EQ(halo->mParent, motion.node("Head"));
    for (unsigned frame = 0; frame < 30; frame += 7) {
        const model::SegmentPose expected = haloOf(sent(0, frame + 1)[kHead]);
        EXPECT_LT((zUp(motion.worldOf(halo, frame).translation(), 1) - expected.position).norm(), 1e-5);
        EXPECT_LT(angleBetween(motion.worldOf(halo, frame), expected.orientation), 1e-3);
    }
}

TEST_F(GlbTest, HoldsSeveralCharacters) {
    perform(settings(2), 40);
    writeWithBodies(source());
    const ImportedMotion motion(path("take.glb"));
    ASSERT_NE(motion.animation(), nullptr) << motion.problem();
    EXPECT_EQ(motion.animation()->mNumChannels, 2U * 24);
    EXPECT_EQ(motion.scene()->mNumMeshes, 2U);
    for (const feed::PoseCharacter& character : source().characters) {
        EXPECT_NE(motion.node(character.name.shown()), nullptr);
    }
}

class HostileAnimationTest : public MotionTest, public testing::WithParamInterface<std::string> {};

TEST_P(HostileAnimationTest, NamesAreTextInGltf) {
    wire::Datagram datagram;
    datagram.body = wire::MetaData{true, "name:" + GetParam() + "\n"};
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    send(datagram, kStart);
    perform(settings(), 3, [](const wire::Datagram& one) { return one.header.type() != 12; });
    const std::string file = written("glb", source());
    const ImportedMotion motion(path("take.glb"));
    ASSERT_NE(motion.animation(), nullptr) << motion.problem();
    EXPECT_NE(motion.node(source().characters[0].name.shown()), nullptr);
}

INSTANTIATE_TEST_SUITE_P(Names, HostileAnimationTest, testing::ValuesIn(test::hostileNames()));

} // namespace
} // namespace posewire::exporting
