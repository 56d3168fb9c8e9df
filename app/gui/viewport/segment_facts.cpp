// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/segment_facts.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/body/joint_angles.h"
#include "core/model/body/provenance.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"

#include <algorithm>
#include <cmath>

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

SegmentFact vectorFact(const QString& name, const Eigen::Vector3d& value, int decimals, const QString& unit) {
    return {name,
            {QString(), fixed(value.x(), decimals), fixed(value.y(), decimals), fixed(value.z(), decimals)},
            unit};
}

/// "Sent", "Position sent, orientation solved".
QString sourceText(const model::SegmentSource& source) {
    const auto in = [](const std::array<QString, 4>& words, model::Provenance provenance) {
        return words[static_cast<std::size_t>(provenance)];
    };
    if (source.position == source.orientation) {
        return in({tr("Missing"), tr("Assumed"), tr("Solved"), tr("Sent")}, source.position);
    }
    const std::array words{tr("missing"), tr("assumed"), tr("solved"), tr("sent")};
    return tr("Position %1, orientation %2").arg(in(words, source.position), in(words, source.orientation));
}

QString sourceOf(const model::CharacterPose& pose, std::size_t segment) {
    constexpr double kSeen = 0.0005; // metres
    QString text = sourceText(pose.sources[segment]);
    if (pose.sources[segment].isTwistAssumed) {
        text += tr(", turn about itself assumed");
    }
    if (pose.isPlaceAssumed) {
        text += tr(", place in the world assumed");
    }
    if (std::abs(pose.moved.z()) >= kSeen) {
        text += tr(", shown %1 m higher").arg(fixed(pose.moved.z(), 2));
    }
    return text;
}

void addMotion(const PoseSubject& subject, std::size_t segment, SegmentFacts& known) {
    constexpr int kDecimals = 2;
    if (const auto* linear = freshBody<wire::LinearKinematics>(subject);
        linear != nullptr && segment < linear->segments.size()) {
        const double unit = model::metresPer(unitOf(subject, wire::LinearKinematics::kType));
        const wire::LinearSegment& sent = linear->segments[segment];
        known.facts.push_back(
            vectorFact(tr("Velocity"), unit * model::toVector(sent.velocity), kDecimals, tr("m/s")));
        known.facts.push_back(
            vectorFact(tr("Acceleration"), unit * model::toVector(sent.acceleration), kDecimals, tr("m/s²")));
    }
    if (const auto* angular = freshBody<wire::AngularKinematics>(subject);
        angular != nullptr && segment < angular->segments.size()) {
        known.facts.push_back(vectorFact(tr("Angular velocity"),
                                         model::toVector(angular->segments[segment].angularVelocity),
                                         kDecimals, tr("rad/s")));
    }
}

void addJoint(const PoseSubject& subject, int segment, SegmentFacts& known) {
    const auto joint = subject.pose.isObjects ? std::nullopt : jointReading(subject, segment);
    if (!joint) {
        return;
    }
    const std::array names{tr("Abduction"), tr("Axial rotation"), tr("Flexion")};
    for (std::size_t i = 0; i < names.size(); ++i) {
        known.facts.push_back({joint->isSent ? names[i] : tr("%1 (computed)").arg(names[i]),
                               {QString(), fixed(joint->degrees[i], 1)},
                               tr("°")});
    }
}

} // namespace

const model::Message* freshMessage(const PoseSubject& subject, std::uint8_t type) {
    constexpr log::Duration kTogether = std::chrono::milliseconds(250);
    const model::Message* message = subject.session.messages().message(subject.key, type);
    return message != nullptr && message->stamp + kTogether >= subject.pose.stamp ? message : nullptr;
}

model::LengthUnit unitOf(const PoseSubject& subject, std::uint8_t type) {
    const model::Sender* sender = subject.session.roster().find(subject.key.sender);
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
        model::jointAngle(definition, turn(definition.parentSegment()), turn(definition.childSegment()),
                          model::stanceOf(subject.session.messages().bodyOrigins(subject.key).places));
    return JointReading{{angles.x(), angles.y(), angles.z()}, false};
}

SegmentFacts segmentFacts(const PoseSubject& subject, int segment) {
    const model::CharacterPose& pose = subject.pose;
    const auto at = static_cast<std::size_t>(segment);
    SegmentFacts known;
    known.mark = characterMark(subject.session, subject.key);
    known.segment = pose.isObjects ? tr("Object %1").arg(segment + 1)
                                   : fromUtf8(model::segmentTitle(pose.layout, segment));
    known.character = characterName(subject.session, subject.key);
    known.source = sourceOf(pose, at);
    const bool isDoubtful = pose.isPlaceAssumed || pose.sources[at].weaker() <= model::Provenance::Assumed;
    known.sourceHealth = isDoubtful ? Health::Warning : Health::Unknown;
    const model::SegmentPose& place = pose.segments[at];
    known.facts.push_back(vectorFact(tr("Position"), place.position - pose.moved, 3, tr("m")));
    const Eigen::Quaterniond& turn = place.orientation;
    known.facts.push_back({tr("Orientation"),
                           {fixed(turn.w(), 3), fixed(turn.x(), 3), fixed(turn.y(), 3), fixed(turn.z(), 3)},
                           {}});
    addMotion(subject, at, known);
    addJoint(subject, segment, known);
    return known;
}

} // namespace posewire::gui
