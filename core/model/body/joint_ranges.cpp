// SPDX-License-Identifier: MIT
#include "core/model/body/joint_ranges.h"

#include "core/model/body/spaces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace posewire::model {
namespace {

struct Degrees {
    int least = 0;
    int most = 0; ///< the same as the least: the source has none
};
/// Abduction, rotation, flexion.
using Reference = std::array<Degrees, 3>;

constexpr Reference kNoReference{};
/// Rotation with the arm held out by 90°.
constexpr Reference kShoulder{{{-75, 180}, {-90, 70}, {-60, 180}}};
/// The source counts 80° of pronation and supination from the thumb up, type 20 from full supination on: 90°
/// between them.
constexpr Reference kElbow{{{}, {10, 170}, {-10, 150}}};
constexpr Reference kWrist{{{-30, 20}, {}, {-70, 80}}};
constexpr Reference kHip{{{-30, 45}, {-45, 45}, {-30, 120}}};
constexpr Reference kKnee{{{}, {}, {-10, 135}}};
/// Eversion 15°, inversion 35°; dorsiflexion 20°.
constexpr Reference kAnkle{{{-35, 15}, {}, {-50, 20}}};
/// Ranges of the great toe.
constexpr Reference kBallOfFoot{{{}, {}, {-45, 70}}};

/// In the order of jointDefinitions().
constexpr std::array<Reference, kBodyJointCount> kReferences{
    kNoReference, kNoReference, kNoReference, kNoReference, kNoReference, kNoReference, // spine
    kNoReference, kShoulder,    kElbow,       kWrist,                                   // right arm
    kNoReference, kShoulder,    kElbow,       kWrist,                                   // left arm
    kHip,         kKnee,        kAnkle,       kBallOfFoot,                              // right leg
    kHip,         kKnee,        kAnkle,       kBallOfFoot,                              // left leg
};

} // namespace

void AngleRange::add(const AngleRange& other) {
    least = std::min(least, other.least);
    most = std::max(most, other.most);
}

double AngleRange::excess(double angle) const {
    return std::max({0.0, least - angle, angle - most});
}

std::optional<AngleRange> referenceRange(std::size_t joint, std::size_t axis) {
    const Degrees& range = kReferences[joint][axis];
    return range.least == range.most
               ? std::nullopt
               : std::optional(AngleRange{range.least * kRadiansPerDegree, range.most * kRadiansPerDegree});
}

Eigen::Vector3d anatomicalAngles(std::size_t joint, const Eigen::Vector3d& angles) {
    std::array<Eigen::Vector3d, 2> forms = equalForms(angles);
    std::array<double, 2> excess{};
    for (std::size_t i = 0; i < forms.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto reference = referenceRange(joint, axis);
            const double middle = reference ? (reference->least + reference->most) / 2 : 0;
            double& angle = forms[i][static_cast<Eigen::Index>(axis)];
            angle = middle + std::remainder(angle - middle, 2 * std::numbers::pi);
            excess[i] += reference ? reference->excess(angle) : std::abs(angle);
        }
    }
    return forms[excess[1] < excess[0] ? 1 : 0];
}

void JointExtents::add(const BodyAngles& angles) {
    for (std::size_t joint = 0; joint < angles.size(); ++joint) {
        if (!angles[joint].allFinite()) {
            continue;
        }
        const Eigen::Vector3d taken = anatomicalAngles(joint, angles[joint]);
        const std::size_t axes = isNearGimbalLock(taken) ? 1 : 3;
        for (std::size_t axis = 0; axis < axes; ++axis) {
            const double angle = taken[static_cast<Eigen::Index>(axis)];
            m_ranges[joint][axis].add({angle, angle});
        }
    }
    ++m_samples;
}

void JointExtents::add(const JointExtents& other) {
    for (std::size_t joint = 0; joint < m_ranges.size(); ++joint) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            m_ranges[joint][axis].add(other.m_ranges[joint][axis]);
        }
    }
    m_samples += other.m_samples;
}

bool JointExtents::isBeyond(std::size_t joint, std::size_t axis) const {
    const AngleRange& taken = range(joint, axis);
    const auto reference = referenceRange(joint, axis);
    return reference && !taken.isEmpty() &&
           (reference->excess(taken.least) > 0 || reference->excess(taken.most) > 0);
}

} // namespace posewire::model
