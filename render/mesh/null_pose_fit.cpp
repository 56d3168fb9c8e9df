// SPDX-License-Identifier: MIT
#include "render/mesh/null_pose_fit.h"

#include "render/mesh/finite.h"

#include <algorithm>
#include <cmath>

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
    Fit(std::span<const glm::vec3> reference, std::span<const glm::vec3> performer)
        : m_reference(reference), m_girth(girthOf(statureRatio(reference, performer))) {
        for (std::size_t i = 0; i < kSegmentCount; ++i) {
            m_origins[i] = usableOrigin(i, performer);
        }
    }

    const NullPose& origins() const { return m_origins; }

    Stretches stretches() const {
        Stretches all;
        for (std::size_t i = 0; i < kSegmentCount; ++i) {
            all[i] = {m_reference[i], m_origins[i], scaleOf(static_cast<Segment>(i))};
        }
        for (std::size_t i = 0; i < kTwistJointCount; ++i) {
            all[kSegmentCount + i] = all[kTwistJoints[i].segment];
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
    if (positions.size() != mesh->vertexCount() || normals.size() != mesh->vertexCount()) {
        return tl::make_unexpected("the output differs in size from the mesh");
    }
    return mesh->validate(kJointCount);
}

void NullPoseFitJob::run() const {
    const Fit fit(reference, performer);
    std::copy(fit.origins().begin(), fit.origins().end(), origins.begin());
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

SkinnedMesh fitToNullPose(const SkinnedMesh& mesh, const NullPose& performer, NullPose& usedOrigins) {
    SkinnedMesh fitted = mesh;
    const NullPoseFitJob job{&mesh,          kReferenceNullPose, performer, fitted.positions,
                             fitted.normals, usedOrigins};
    job.run();
    return fitted;
}

} // namespace posewire::render
