// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/figure/mannequin_body.h"

#include "render/mesh/linear_body.h"
#include "render/mesh/mannequin.h"

#include <algorithm>
#include <iterator>

namespace posewire::figure {
namespace {

std::array<float, 3> plain(const glm::vec3& vector) {
    return {vector.x, vector.y, vector.z};
}

Eigen::Vector3d wide(const glm::vec3& vector) {
    return {vector.x, vector.y, vector.z};
}

glm::vec3 narrow(const Eigen::Vector3d& vector) {
    return {static_cast<float>(vector.x()), static_cast<float>(vector.y()), static_cast<float>(vector.z())};
}

constexpr std::size_t kFirstFinger = model::kBodySegments + model::kMaxPropCount;

/// In model::kAllSegments.
int slotOfJoint(std::size_t joint) {
    return static_cast<int>(joint < render::kSegmentCount ? joint
                                                          : joint - render::kFirstFingerJoint + kFirstFinger);
}

/// Poses of segments as the palette takes them.
class Poser {
public:
    Poser(std::vector<render::LinearJoint> joints, const render::BodyFit& fit, bool hasLeft, bool hasRight)
        : m_joints(std::move(joints)), m_fit(fit), m_hasLeft(hasLeft), m_hasRight(hasRight) {}

    void operator()(std::span<const model::SegmentPose> segments, std::span<model::SegmentPose> joints) {
        for (std::size_t i = 0; i < segments.size(); ++i) {
            m_positions[i] = narrow(segments[i].position);
            const Eigen::Quaternionf turn = segments[i].orientation.cast<float>();
            m_orientations[i] = glm::quat(turn.w(), turn.x(), turn.y(), turn.z());
        }
        const auto hand = [&](bool isSent, std::size_t first) {
            constexpr std::size_t count = render::kHandSegmentCount;
            return isSent ? render::FingerPose{std::span(m_positions).subspan(first, count),
                                               std::span(m_orientations).subspan(first, count)}
                          : render::FingerPose{};
        };
        render::PaletteJob{std::span(m_positions).first(render::kSegmentCount),
                           std::span(m_orientations).first(render::kSegmentCount),
                           m_fit.origins,
                           m_palette,
                           hand(m_hasLeft, kFirstFinger),
                           hand(m_hasRight, kFirstFinger + render::kHandSegmentCount),
                           m_fit.fingerOrigins}
            .run();
        std::ranges::transform(m_joints, joints.begin(), [this](const render::LinearJoint& joint) {
            const render::LinearPlace at = render::placeOf(joint, m_palette);
            const glm::quat& turn = at.orientation;
            return model::SegmentPose{wide(at.position), Eigen::Quaterniond(turn.w, turn.x, turn.y, turn.z)};
        });
    }

private:
    std::vector<render::LinearJoint> m_joints;
    render::BodyFit m_fit;
    bool m_hasLeft;
    bool m_hasRight;
    std::array<glm::vec3, model::kMaxSegmentCount> m_positions{};
    std::array<glm::quat, model::kMaxSegmentCount> m_orientations{};
    std::array<render::DualQuaternion, render::kJointCount> m_palette;
};

} // namespace

exporting::BodyMesh mannequinBody(const exporting::SegmentPlaces& performer) {
    static const render::SkinnedMesh mannequin = render::loadMannequin(render::Detail::Medium);
    render::NullPose pose{};
    render::FingerOrigins fingers{};
    std::transform(performer.begin(), performer.begin() + pose.size(), pose.begin(), narrow);
    std::transform(performer.begin() + kFirstFinger, performer.end(), fingers.begin(), narrow);
    const bool hasLeft = performer[kFirstFinger].allFinite();
    const bool hasRight = performer[kFirstFinger + render::kHandSegmentCount].allFinite();
    const render::BodyFit fit = render::fitBody(pose, fingers);
    const render::LinearBody fitted = render::linearBody(mannequin, fit, hasLeft, hasRight);
    exporting::BodyMesh body;
    std::ranges::transform(fitted.mesh.positions, std::back_inserter(body.positions), plain);
    std::ranges::transform(fitted.mesh.normals, std::back_inserter(body.normals), plain);
    std::ranges::transform(fitted.mesh.weights, std::back_inserter(body.weights), [](const glm::vec4& one) {
        return std::array{one.x, one.y, one.z, one.w};
    });
    body.joints = fitted.mesh.joints;
    body.indices = fitted.mesh.indices;
    for (const render::LinearJoint& joint : fitted.joints) {
        body.skeleton.push_back({joint.isSegment ? std::string() : joint.name, slotOfJoint(joint.segment),
                                 wide(joint.origin), joint.isShifted});
    }
    body.pose = Poser(fitted.joints, fit, hasLeft, hasRight);
    return body;
}

} // namespace posewire::figure
