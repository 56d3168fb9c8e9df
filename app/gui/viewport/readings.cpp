// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/readings.h"

#include "core/model/body/joint_angles.h"

#include <algorithm>

namespace posewire::gui {
namespace {

/// The row of type 20 between a segment and its parent; nothing for the pelvis.
std::optional<std::size_t> jointOf(int segment) {
    if (segment < 0 || segment >= model::kBodySegmentCount) {
        return std::nullopt;
    }
    const auto& joints = model::jointDefinitions();
    const int parent = model::bodySegments()[static_cast<std::size_t>(segment)].parent;
    const auto found = std::ranges::find_if(joints, [=](const model::JointDefinition& joint) {
        return joint.childSegment() == segment && joint.parentSegment() == parent;
    });
    return found == joints.end() ? std::nullopt
                                 : std::optional(static_cast<std::size_t>(found - joints.begin()));
}

} // namespace

const model::Message* freshMessage(const PoseSubject& subject, std::uint8_t type) {
    constexpr log::Duration kTogether = std::chrono::milliseconds(250);
    const model::Message* message = subject.session.message(subject.key, type);
    return message != nullptr && message->stamp + kTogether >= subject.pose.stamp ? message : nullptr;
}

model::LengthUnit unitOf(const PoseSubject& subject, std::uint8_t type) {
    const model::Sender* sender = subject.session.find(subject.key.sender);
    return sender != nullptr ? sender->positionUnit(type) : model::LengthUnit::Metre;
}

std::optional<JointReading> jointReading(const PoseSubject& subject, int segment) {
    const auto joint = jointOf(segment);
    if (!joint) {
        return std::nullopt;
    }
    if (const auto* sent = freshBody<wire::JointAngles>(subject);
        sent != nullptr && *joint < sent->joints.size()) {
        const wire::Vec3& angles = sent->joints[*joint].rotation;
        return JointReading{{angles[0], angles[1], angles[2]}, true};
    }
    const model::JointDefinition& definition = model::jointDefinitions()[*joint];
    const auto turn = [&](int one) {
        return subject.pose.segments[static_cast<std::size_t>(one)].orientation;
    };
    const Eigen::Vector3d angles =
        model::kDegreesPerRadian *
        model::jointAngle(definition, turn(definition.parentSegment()), turn(definition.childSegment()));
    return JointReading{{angles.x(), angles.y(), angles.z()}, false};
}

} // namespace posewire::gui
