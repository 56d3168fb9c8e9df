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
float statureRatio(std::span<const glm::vec3> reference, std::span<const glm::vec3> performer) {
    const auto height = [](std::span<const glm::vec3> origins) {
        return origins[Head].z - 0.5F * (origins[LeftFoot].z + origins[RightFoot].z);
    };
    const auto trunk = [](std::span<const glm::vec3> origins) { return origins[Head].z - origins[Pelvis].z; };
    const float whole = height(performer) / height(reference);
    if (isUsable(whole)) {
        return whole;
    }
    const float upper = trunk(performer) / trunk(reference);
    return isUsable(upper) ? upper : 1.0F;
}

struct Stretch {
    glm::vec3 from;
    glm::vec3 to;
    glm::vec3 scale;

    glm::vec3 operator()(const glm::vec3& v) const { return to + scale * (v - from); }
};

using Stretches = std::array<Stretch, kJointCount>;

class Fit {
public:
    Fit(std::span<const glm::vec3> reference, std::span<const glm::vec3> performer,
        std::span<const glm::vec3> performerFingers)
        : m_reference(reference), m_girth(girthOf(statureRatio(reference, performer))) {
        for (std::size_t i = 0; i < kSegmentCount; ++i) {
            m_origins[i] = usableOrigin(i, performer);
        }
        for (std::size_t i = 0; i < kFingerJointCount; ++i) {
            const glm::vec3 unknown(std::numeric_limits<float>::quiet_NaN());
            m_fingers[i] = usableFinger(i, performerFingers.empty() ? unknown : performerFingers[i]);
        }
    }

    const NullPose& origins() const { return m_origins; }
    const FingerOrigins& fingers() const { return m_fingers; }

    Stretches stretches() const {
        Stretches all;
        for (std::size_t i = 0; i < kSegmentCount; ++i) {
            all[i] = {m_reference[i], m_origins[i], scaleOf(static_cast<Segment>(i))};
        }
        for (std::size_t i = kSegmentCount; i < kJointCount; ++i) {
            all[i] = all[jointSegment(i)];
        }
        for (std::size_t i = 0; i < kFingerJointCount; ++i) {
            all[kFirstFingerJoint + i] = {restOf(i), m_fingers[i], fingerScale(i)};
        }
        return all;
    }

private:
    /// The performer's origin where its bone has a sane length, else the reference's bone in the performer's
    /// size.
    glm::vec3 usableOrigin(std::size_t i, std::span<const glm::vec3> performer) const {
        if (kSegmentParents[i] < 0) {
            const bool isNear = isFinite(performer[i]) && glm::length(performer[i]) <= kFarthestPelvis;
            return isNear ? performer[i] : m_reference[i];
        }
        const auto parent = static_cast<std::size_t>(kSegmentParents[i]);
        const glm::vec3 bone = m_reference[i] - m_reference[parent];
        const glm::vec3 sent = performer[i] - performer[parent];
        const bool isSane = isFinite(sent) && isUsable(glm::length(sent) / glm::length(bone));
        return m_origins[parent] + (isSane ? sent : m_girth * bone);
    }

    /// Where the mesh was made with a finger, for the reference it was made for.
    glm::vec3 restOf(std::size_t finger) const {
        const std::size_t joint = kFirstFingerJoint + finger;
        const Segment hand = jointSegment(joint);
        return m_reference[hand] + (jointOrigin(joint) - kReferenceNullPose[hand]);
    }

    /// The finger's origin as sent where it is about as far from the wrist as it should be, else as the
    /// hand's size has it.
    glm::vec3 usableFinger(std::size_t finger, const glm::vec3& sent) const {
        const Segment hand = jointSegment(kFirstFingerJoint + finger);
        const glm::vec3 reach = restOf(finger) - m_reference[hand];
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
                     m_reference[to][axis] - m_reference[from][axis]);
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

    std::span<const glm::vec3> m_reference;
    float m_girth;
    NullPose m_origins{};
    FingerOrigins m_fingers{};
};

} // namespace

tl::expected<void, std::string> NullPoseFitJob::validate() const {
    if (mesh == nullptr) {
        return tl::make_unexpected("there is no mesh to fit");
    }
    if (reference.size() != kSegmentCount || performer.size() != kSegmentCount ||
        origins.size() != kSegmentCount) {
        return tl::make_unexpected("a null pose has the origins of 23 segments");
    }
    if ((!performerFingers.empty() && performerFingers.size() != kFingerJointCount) ||
        (!fingerOrigins.empty() && fingerOrigins.size() != kFingerJointCount)) {
        return tl::make_unexpected("both hands have 40 segments");
    }
    if (positions.size() != mesh->vertexCount() || normals.size() != mesh->vertexCount()) {
        return tl::make_unexpected("the output differs in size from the mesh");
    }
    return mesh->validate(kJointCount);
}

void NullPoseFitJob::run() const {
    const Fit fit(reference, performer, performerFingers);
    std::ranges::copy(fit.origins(), origins.begin());
    std::copy_n(fit.fingers().begin(), fingerOrigins.size(), fingerOrigins.begin());
    const Stretches stretches = fit.stretches();
    for (std::size_t i = 0; i < positions.size(); ++i) {
        glm::vec3 place(0.0F);
        glm::vec3 scale(0.0F);
        for (std::size_t k = 0; k < mesh->joints[i].size(); ++k) {
            const float weight = mesh->weights[i][static_cast<int>(k)];
            const Stretch& stretch = stretches[mesh->joints[i][k]];
            place += weight * stretch(mesh->positions[i]);
            scale += weight * stretch.scale;
        }
        positions[i] = place;
        normals[i] = glm::normalize(mesh->normals[i] / scale);
    }
}

FingerOrigins fittedFingers(std::span<const glm::vec3> origins) {
    return Fit(kReferenceNullPose, origins, {}).fingers();
}

SkinnedMesh fitToNullPose(const SkinnedMesh& mesh, const NullPose& performer,
                          const FingerOrigins& performerFingers, NullPose& usedOrigins,
                          FingerOrigins& usedFingers) {
    SkinnedMesh fitted = mesh;
    const NullPoseFitJob job{&mesh,          kReferenceNullPose, performer,        fitted.positions,
                             fitted.normals, usedOrigins,        performerFingers, usedFingers};
    job.run();
    return fitted;
}

SkinnedMesh fitToNullPose(const SkinnedMesh& mesh, const NullPose& performer, NullPose& usedOrigins) {
    SkinnedMesh fitted = mesh;
    const NullPoseFitJob job{&mesh,          kReferenceNullPose, performer, fitted.positions,
                             fitted.normals, usedOrigins};
    job.run();
    return fitted;
}

} // namespace posewire::render
