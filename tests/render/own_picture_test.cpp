// SPDX-License-Identifier: MIT
#include "tests/render/rig.h"
#include "tests/render/studio.h"

namespace posewire::render::test {
namespace {

/// A weave of two colours, finer along the bones.
TextureImage weave() {
    constexpr int kSide = 64;
    TextureImage image{kSide, kSide, {}};
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const bool isDark = (x / 8 + y / 8) % 2 == 0;
            const bool isTop = y < 6;
            for (const int value : {isTop    ? 200
                                    : isDark ? 60
                                             : 205,
                                    isTop    ? 90
                                    : isDark ? 110
                                             : 190,
                                    isTop    ? 60
                                    : isDark ? 100
                                             : 150,
                                    255}) {
                image.texels.push_back(static_cast<std::uint8_t>(value));
            }
        }
    }
    return image;
}

class OwnPicture : public Studio {
protected:
    void SetUp() override {
        Studio::SetUp();
        const ImportedCharacter character = Rig{}.character();
        auto body = makeOwnBody(character, mapBones(character.bones), {});
        ASSERT_TRUE(body) << body.error();
        m_body = std::move(*body);
    }

    MeshId upload(const std::vector<MeshPart>& parts, std::span<const TextureImage> textures) {
        return renderer().uploadMesh(
            m_body.mesh, {m_body.jointSegments, m_body.segmentJoints, m_body.texturePlaces, parts, textures});
    }
    MeshId uploadTextured() {
        std::vector<MeshPart> parts = m_body.parts;
        parts[0].texture = 0;
        const std::array textures{weave()};
        return upload(parts, textures);
    }

    SkinnedInstance& addOwn(MeshId id, const Pose& pose, const glm::vec3& colour = kBlue) {
        std::vector<DualQuaternion> palette(m_body.joints.size());
        const std::vector<DualQuaternion> mannequin = paletteOf(pose);
        OwnPaletteJob{&m_body, scaleFor(m_body, kReferenceNullPose), mannequin, kReferenceNullPose, palette}
            .run();
        SkinnedInstance& instance = add(pose, colour);
        instance.mesh = id;
        instance.palette = addPalette(palette);
        return instance;
    }

    const OwnBody& body() const { return m_body; }

private:
    OwnBody m_body;
};

TEST_F(OwnPicture, ShowsTheTPoseOfACharacterWhoseArmsHangAtRest) {
    addOwn(uploadTextured(), tPose());
    expectMatchesBaseline(shoot(), "own_t_pose");
}

TEST_F(OwnPicture, ShowsALungeBesideTheMannequin) {
    addOwn(uploadTextured(), placed(lungePose(), {0.0F, -0.7F, 0.0F}));
    add(grounded(placed(lungePose(), {0.0F, 0.7F, 0.0F}), mesh()));
    look(0.57F, {0.0F, 0.0F, 0.75F}, 5.0F);
    scene.colours = darkSceneColours();
    expectMatchesBaseline(shoot(), "own_lunge_dark");
}

TEST_F(OwnPicture, WearsTheColourOfItsMaterialOrElseItsOwn) {
    std::vector<MeshPart> parts = body().parts;
    MeshPart second = parts[0];
    parts[0].indexCount = 60 * (parts[0].indexCount / 120);
    second.firstIndex = parts[0].indexCount;
    second.indexCount -= parts[0].indexCount;
    second.hasColour = true;
    second.colour = {0.75F, 0.60F, 0.20F};
    parts.push_back(second);
    addOwn(upload(parts, {}), standingPose(), kOrange);
    expectMatchesBaseline(shoot(), "own_materials");
}

TEST_F(OwnPicture, ShowsProvenanceSelectionAndStaleness) {
    const MeshId id = uploadTextured();
    CharacterLook& left = addOwn(id, placed(standingPose(), {0.0F, -0.75F, 0.0F})).look;
    for (const Segment segment : {LeftUpperArm, LeftForeArm, LeftHand, RightLowerLeg, RightFoot, RightToe}) {
        left.provenance[segment] = Provenance::Assumed;
    }
    left.provenance[RightForeArm] = Provenance::Solved;
    left.isSelected = true;
    left.selectedSegment = Head;
    CharacterLook& right = addOwn(id, placed(elbowPose(), {0.0F, 0.75F, 0.0F})).look;
    right.dim = 0.6F;
    right.isHatched = true;
    look(0.25F, {0.0F, 0.0F, 0.85F}, 5.2F);
    expectMatchesBaseline(shoot(), "own_looks");
}

TEST_F(OwnPicture, RefusesWhatDoesNotFitTogether) {
    std::vector<MeshPart> parts = body().parts;
    parts[0].indexCount += 3;
    EXPECT_EQ(upload(parts, {}), MeshId::None);
    EXPECT_EQ(upload({}, {}), MeshId::None);
    EXPECT_EQ(renderer().uploadMesh(body().mesh, MeshDress{}), MeshId::None);
    parts = body().parts;
    parts[0].texture = 7;
    const std::array textures{TextureImage{4, 4, {1, 2, 3}}};
    EXPECT_NE(upload(parts, textures), MeshId::None) << "without its texture";
}

TEST_F(OwnPicture, SkinsByTheShaderAsByTheReference) {
    const MeshId id = uploadTextured();
    const SkinnedInstance& instance = addOwn(id, elbowPose());
    SkinnedMesh expected = body().mesh;
    const SkinJob job{&body().mesh, instance.palette, expected.positions, expected.normals};
    job.run();
    const std::vector<glm::vec3> found = renderer().skinnedPositions(id, instance.palette);
    ASSERT_EQ(found.size(), expected.positions.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        ASSERT_LT(glm::distance(found[i], expected.positions[i]), 4e-5F);
    }
}

} // namespace
} // namespace posewire::render::test
