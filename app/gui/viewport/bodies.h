// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model/body/character_pose.h"
#include "core/model/body/null_pose.h"
#include "core/model/body/reference_body.h"
#include "render/mesh/mannequin.h"
#include "render/mesh/null_pose_fit.h"
#include "render/mesh/own_body.h"
#include "render/picking.h"
#include "render/scene.h"
#include "render/skinning.h"

#include <QString>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace posewire::gui {

/// The mannequin as it was modelled, in the levels that are drawn; all characters share it.
struct MannequinMeshes {
    render::SkinnedMesh mesh;
    render::SkinnedMesh lowMesh; ///< in fewer triangles
    render::SegmentCapsules capsules{};
};

/// The mannequin fitted to one performer; never changed once made, so that threads may share it.
struct FigureBody {
    std::shared_ptr<const MannequinMeshes> mannequin;
    render::BodyFit fit;
    render::SegmentCapsules capsules{};
};

/// The mannequin as it fits each body, worked out once for all who have the same. At most kMost are kept,
/// those that were shown last.
class BodyFits {
public:
    static constexpr std::size_t kMost = 64;

    explicit BodyFits(render::Detail detail) : m_detail(detail) {}

    /// By the segment origins of a null pose, metres; they may be of any value. Fingers that are not numbers
    /// fit the hands.
    [[nodiscard]] std::shared_ptr<const FigureBody>
    of(const render::NullPose& performer, const render::FingerOrigins& fingers = render::unknownFingers());

    /// With the mannequin once more on the graphics side.
    [[nodiscard]] std::size_t memoryBytes() const;
    /// 0 before anything was asked for.
    [[nodiscard]] std::size_t mostBytes() const;

private:
    /// As they came, so that what is not a number equals itself.
    using Body = std::array<std::uint32_t, 3 * (render::kSegmentCount + render::kFingerJointCount)>;
    struct Entry {
        std::shared_ptr<const FigureBody> body;
        std::uint64_t asked = 0; ///< when last
    };
    [[nodiscard]] std::size_t mannequinBytes() const;

    const render::Detail m_detail;
    std::shared_ptr<const MannequinMeshes> m_mannequin;
    std::map<Body, Entry> m_entries;
    std::uint64_t m_asked = 0;
};

/// A user's own character with its textures; never changed once made, so that threads may share it.
struct DressedBody {
    render::OwnBody body;
    std::shared_ptr<const std::vector<render::TextureImage>> textures;
    /// Larger or smaller for each performer; else as large as the file has it.
    bool isScaled = true;

    [[nodiscard]] std::size_t meshBytes() const;
    [[nodiscard]] std::size_t textureBytes() const;
};

/// By the name that a character is shown by.
struct Wardrobe {
    std::shared_ptr<const DressedBody> forAll; ///< null for the mannequin
    std::map<QString, std::shared_ptr<const DressedBody>> byName;

    [[nodiscard]] bool isEmpty() const { return forAll == nullptr && byName.empty(); }
    [[nodiscard]] std::shared_ptr<const DressedBody> of(const QString& name) const;
};

/// Such a body as large as one performer.
struct OwnFigure {
    std::shared_ptr<const DressedBody> dressed;
    float scale = 1.0F;
    render::SkinnedMesh mesh;
    render::SegmentCapsules capsules{};
    float top = 0.0F; ///< of the mesh above the origin of the head, metres

    /// For uploading.
    [[nodiscard]] render::MeshDress dress() const;
};

[[nodiscard]] std::shared_ptr<const OwnFigure> sized(std::shared_ptr<const DressedBody> dressed, float scale);

/// Bodies of the user's own as they fit each performer, made once for all of about the same size. At most
/// kMost are kept, those that were shown last.
class OwnFigures {
public:
    static constexpr std::size_t kMost = 12;

    /// `origins`: of the performer's null pose.
    [[nodiscard]] std::shared_ptr<const OwnFigure> of(const std::shared_ptr<const DressedBody>& dressed,
                                                      const render::NullPose& origins);

    /// As much again is on the graphics side; textures once for each figure there.
    [[nodiscard]] std::size_t memoryBytes() const;
    [[nodiscard]] std::size_t mostBytes() const;

private:
    struct Entry {
        std::shared_ptr<const OwnFigure> figure;
        std::uint64_t used = 0;
    };
    std::vector<Entry> m_entries;
    std::uint64_t m_uses = 0;
};

/// The fingers of one character as the palette wants them, the left hand first.
struct PosedHands {
    std::array<glm::vec3, render::kFingerJointCount> positions{};
    std::array<glm::quat, render::kFingerJointCount> orientations{};
    bool hasLeft = false;
    bool hasRight = false;

    [[nodiscard]] render::FingerPose left() const;
    [[nodiscard]] render::FingerPose right() const;
};

/// A hand without any finger in the pose is left out; of others, missing segments are not numbers.
[[nodiscard]] PosedHands handsOf(const model::CharacterPose& pose);

/// Where a scale message has the fingers, moved to where `body` has the hands; not a number where it has
/// none.
[[nodiscard]] render::FingerOrigins fingerOriginsOf(const model::NullPose& nullPose,
                                                    const model::BodyOrigins& body);

} // namespace posewire::gui
