// SPDX-License-Identifier: MIT
#include "render/mesh/null_pose_fit.h"

#include "render/mesh/finite.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace posewire::render {
namespace {

/// People and the reference differ by less than this factor and its inverse.
constexpr float kLargestRatio = 3.0F;
/// A pelvis farther from the origin than this is no null pose.
constexpr float kFarthestPelvis = 10.0F;

bool isUsable(float ratio) {
    return ratio >= 1.0F / kLargestRatio && ratio <= kLargestRatio;
}

/// How much wider than the reference a body of this relative stature is. Adults scale evenly; children are
/// stouter.
float girthOf(float ratio) {
    const float stature = kReferenceStature * ratio;
    const float t = std::clamp((stature - 1.2F) / 0.3F, 0.0F, 1.0F);
    const float exponent = glm::mix(0.7F, 1.0F, t * t * (3.0F - 2.0F * t));
    return std::pow(ratio, exponent);
}

/// From ankles to head: nothing here depends on where the null pose has its floor.
float statureRatio(std::span<const glm::vec3> performer) {
    const auto height = [](std::span<const glm::vec3> origins) {
        return origins[Head].z - 0.5F * (origins[LeftFoot].z + origins[RightFoot].z);
    };
    const auto trunk = [](std::span<const glm::vec3> origins) { return origins[Head].z - origins[Pelvis].z; };
    const float whole = height(performer) / height(kReferenceNullPose);
    if (isUsable(whole)) {
        return whole;
    }
    const float upper = trunk(performer) / trunk(kReferenceNullPose);
    return isUsable(upper) ? upper : 1.0F;
}

class Fit {
public:
    Fit(std::span<const glm::vec3> performer, const FingerOrigins& performerFingers)
        : m_girth(girthOf(statureRatio(performer))) {
        for (std::size_t i = 0; i < kSegmentCount; ++i) {
            m_origins[i] = usableOrigin(i, performer);
        }
        for (std::size_t i = 0; i < kFingerJointCount; ++i) {
            m_fingers[i] = usableFinger(i, performerFingers[i]);
        }
    }

    const NullPose& origins() const { return m_origins; }
    const FingerOrigins& fingers() const { return m_fingers; }

    std::array<Stretch, kJointCount> stretches() const {
        std::array<Stretch, kJointCount> all;
        const auto between = [](const glm::vec3& from, const glm::vec3& to, const glm::vec3& scale) {
            return Stretch{scale, to - scale * from};
        };
        for (std::size_t i = 0; i < kSegmentCount; ++i) {
            all[i] = between(kReferenceNullPose[i], m_origins[i], scaleOf(static_cast<Segment>(i)));
        }
        for (std::size_t i = kSegmentCount; i < kFirstFingerJoint; ++i) {
            all[i] = all[jointSegment(i)];
        }
        for (std::size_t i = 0; i < kFingerJointCount; ++i) {
            all[kFirstFingerJoint + i] = between(restOf(i), m_fingers[i], fingerScale(i));
        }
        return all;
    }

private:
    /// The performer's origin where its bone has a sane length, else the reference's bone in the performer's
    /// size.
    glm::vec3 usableOrigin(std::size_t i, std::span<const glm::vec3> performer) const {
        if (kSegmentParents[i] < 0) {
            const bool isNear = isFinite(performer[i]) && glm::length(performer[i]) <= kFarthestPelvis;
            return isNear ? performer[i] : kReferenceNullPose[i];
        }
        const auto parent = static_cast<std::size_t>(kSegmentParents[i]);
        const glm::vec3 bone = kReferenceNullPose[i] - kReferenceNullPose[parent];
        const glm::vec3 sent = performer[i] - performer[parent];
        const bool isSane = isFinite(sent) && isUsable(glm::length(sent) / glm::length(bone));
        return m_origins[parent] + (isSane ? sent : m_girth * bone);
    }

    /// Where the mesh was made with a finger.
    static glm::vec3 restOf(std::size_t finger) { return jointOrigin(kFirstFingerJoint + finger); }

    /// The finger's origin as sent where it is about as far from the wrist as it should be, else as the
    /// hand's size has it.
    glm::vec3 usableFinger(std::size_t finger, const glm::vec3& sent) const {
        const Segment hand = jointSegment(kFirstFingerJoint + finger);
        const glm::vec3 reach = restOf(finger) - kReferenceNullPose[hand];
        const glm::vec3 found = sent - m_origins[hand];
        constexpr float kNear = 0.03F;
        const bool isSane = isFinite(found) && glm::length(found - m_girth * reach) <=
                                                   kNear + 0.5F * m_girth * glm::length(reach);
        return m_origins[hand] + (isSane ? found : m_girth * reach);
    }

    /// Along the finger as the bone's length says, across it as the girth does.
    glm::vec3 fingerScale(std::size_t finger) const {
        const std::size_t index = finger % kHandSegmentCount;
        const bool hasBone = index > 0 && index + 1 < kHandSegmentCount &&
                             kFingerParents[index + 1] == static_cast<int>(index);
        const float along = hasBone ? ratio(glm::distance(m_fingers[finger + 1], m_fingers[finger]),
                                            glm::distance(restOf(finger + 1), restOf(finger)))
                                    : m_girth;
        return {m_girth, along, m_girth};
    }

    float ratio(float performer, float reference) const {
        const float r = performer / reference;
        return isUsable(r) ? r : m_girth;
    }

    /// The stretch along one axis between two segments' origins.
    float between(Segment from, Segment to, int axis) const {
        return ratio(m_origins[to][axis] - m_origins[from][axis],
                     kReferenceNullPose[to][axis] - kReferenceNullPose[from][axis]);
    }

    static Segment childOf(Segment segment) { return static_cast<Segment>(segment + 1); }

    glm::vec3 scaleOf(Segment segment) const {
        const float hips = between(RightUpperLeg, LeftUpperLeg, 1);
        const float shoulders = between(RightUpperArm, LeftUpperArm, 1);
        const float g = m_girth;
        switch (segment) {
        case Pelvis:
            return {g, hips, g};
        case L5:
        case L3:
        case T12:
            return {g, 0.5F * (hips + shoulders), between(segment, childOf(segment), 2)};
        case T8:
            return {g, shoulders, between(T8, Neck, 2)};
        case Neck:
        case RightUpperLeg:
        case RightLowerLeg:
        case LeftUpperLeg:
        case LeftLowerLeg:
            return {g, g, between(segment, childOf(segment), 2)};
        case RightShoulder:
        case RightUpperArm:
        case RightForeArm:
        case LeftShoulder:
        case LeftUpperArm:
        case LeftForeArm:
            return {g, between(segment, childOf(segment), 1), g};
        case RightFoot:
        case LeftFoot:
            return {between(segment, childOf(segment), 0), g, between(segment, childOf(segment), 2)};
        default:
            return glm::vec3(g);
        }
    }

    float m_girth;
    NullPose m_origins{};
    FingerOrigins m_fingers{};
};

} // namespace

const FingerOrigins& unknownFingers() {
    static const FingerOrigins kUnknown = [] {
        FingerOrigins fingers;
        fingers.fill(glm::vec3(std::numeric_limits<float>::quiet_NaN()));
        return fingers;
    }();
    return kUnknown;
}

BodyFit fitBody(const NullPose& performer, const FingerOrigins& fingers) {
    const Fit fit(performer, fingers);
    return {fit.origins(), fit.fingers(), fit.stretches()};
}

SkinnedMesh fitted(const SkinnedMesh& mannequin, const BodyFit& fit) {
    SkinnedMesh mesh = mannequin;
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        Stretch sum{glm::vec3(0.0F), glm::vec3(0.0F)};
        for (std::size_t k = 0; k < mesh.joints[i].size(); ++k) {
            const float weight = mesh.weights[i][static_cast<int>(k)];
            const Stretch& stretch = fit.stretches[mesh.joints[i][k]];
            sum.scale += weight * stretch.scale;
            sum.shift += weight * stretch.shift;
        }
        mesh.positions[i] = sum(mesh.positions[i]);
        mesh.normals[i] = glm::normalize(mesh.normals[i] / sum.scale);
    }
    return mesh;
}

FingerOrigins fittedFingers(std::span<const glm::vec3> origins) {
    return Fit(origins, unknownFingers()).fingers();
}

} // namespace posewire::render
