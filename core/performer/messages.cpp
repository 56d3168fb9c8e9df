// SPDX-License-Identifier: MIT
#include "core/performer/messages.h"

#include "core/model/body/joint_angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace posewire::performer {
namespace {

using Eigen::Vector3d;
using model::toFloats;

/// One item for each segment, made by `make(id, state)`.
template <typename Item, typename Make>
void perSegment(const Subject& subject, std::vector<Item>& items, Make make) {
    const auto& states = subject.moment.segments;
    items.reserve(states.size());
    for (std::size_t place = 0; place < states.size(); ++place) {
        const int position = static_cast<int>(place);
        items.push_back(
            make(segmentId(subject.character.layout(), position, subject.dialect), states[place]));
    }
}

void putDigits(std::uint64_t value, std::size_t first, std::size_t count, std::array<char, 12>& text) {
    for (std::size_t place = count; place-- > 0; value /= 10) {
        text[first + place] = static_cast<char>('0' + value % 10);
    }
}

} // namespace

std::uint32_t segmentId(const model::SegmentLayout& layout, int position, const MessageDialect& dialect) {
    const bool isBody = position < layout.body;
    return static_cast<std::uint32_t>(isBody ? position + 1 : position - layout.body + dialect.firstPropId);
}

void perform(const Subject& subject, wire::PoseEuler& message) {
    perSegment(subject, message.segments, [](std::uint32_t id, const SegmentState& state) {
        const wire::SegmentEuler item = model::eulerFromPose(state.pose);
        return wire::SegmentEuler{id, item.position, item.rotation};
    });
}

void perform(const Subject& subject, wire::PoseQuaternion& message) {
    perSegment(subject, message.segments, [](std::uint32_t id, const SegmentState& state) {
        return wire::SegmentQuaternion{id, toFloats(state.pose.position), toFloats(state.pose.orientation)};
    });
}

void perform(const Subject& subject, wire::PointPositions& message) {
    const auto points = model::anatomicalPoints();
    for (const int marker : model::markerPoints()) {
        const auto place = static_cast<std::size_t>(marker);
        const model::AnatomicalPoint& point = points[place];
        const model::SegmentPose& segment =
            subject.moment.segments[static_cast<std::size_t>(point.segment)].pose;
        const Vector3d position =
            segment.position + segment.orientation * subject.character.body().points[place];
        message.points.push_back(
            {model::encodePointId(subject.dialect.pointIds, {point.segment + 1, point.localId}),
             model::yUpFromPoint(position)});
    }
}

void perform(const Subject& subject, wire::TagPositions& message) {
    constexpr double kRoundsPerSecond = 0.05;
    constexpr double kRadius = 2.5;
    const double angle = 2.0 * std::numbers::pi * kRoundsPerSecond * subject.seconds;
    const Vector3d carried(kRadius * std::cos(angle), kRadius * std::sin(angle), 1.1);
    const Vector3d lying(1.8, -1.2, 0.02);
    message.points = {{101, model::yUpFromPoint(carried)}, {102, model::yUpFromPoint(lying)}};
}

void perform(const Subject& subject, wire::PoseUnity& message) {
    const auto& segments = subject.moment.segments;
    const auto& order = model::unityOrder();
    for (std::size_t place = 0; place < order.size(); ++place) {
        const auto index = static_cast<std::size_t>(order[place]);
        const int parent = model::bodySegments()[index].parent;
        const model::SegmentPose& world = segments[index].pose;
        const wire::SegmentQuaternion item = model::unityFromPose(
            parent < 0 ? world : model::relativeTo(segments[static_cast<std::size_t>(parent)].pose, world));
        message.segments.push_back({static_cast<std::uint32_t>(place + 1), item.position, item.orientation});
    }
}

void perform(const Subject& subject, wire::JointAngles& message) {
    std::array<Eigen::Quaterniond, model::kBodySegmentCount> orientations;
    std::ranges::transform(std::span(subject.moment.segments).first<model::kBodySegmentCount>(),
                           orientations.begin(),
                           [](const SegmentState& state) { return state.pose.orientation; });
    std::array<Vector3d, model::kJointCount> angles;
    model::jointAngles(orientations, angles);
    for (std::size_t row = 0; row < angles.size(); ++row) {
        const model::JointDefinition& joint = model::jointDefinitions()[row];
        message.joints.push_back({model::encodePointId(model::PointIdCoding::By256, joint.parent),
                                  model::encodePointId(model::PointIdCoding::By256, joint.child),
                                  toFloats(Vector3d(angles[row] * model::kDegreesPerRadian))});
    }
}

void perform(const Subject& subject, wire::LinearKinematics& message) {
    perSegment(subject, message.segments, [](std::uint32_t id, const SegmentState& state) {
        return wire::LinearSegment{id, toFloats(state.pose.position), toFloats(state.velocity),
                                   toFloats(state.acceleration)};
    });
}

void perform(const Subject& subject, wire::AngularKinematics& message) {
    perSegment(subject, message.segments, [](std::uint32_t id, const SegmentState& state) {
        return wire::AngularSegment{id, toFloats(state.pose.orientation), toFloats(state.angularVelocity),
                                    toFloats(state.angularAcceleration)};
    });
}

void perform(const Subject& subject, wire::TrackerKinematics& message) {
    for (const TrackerReading& reading : subject.moment.trackers) {
        message.trackers.push_back({static_cast<std::uint32_t>(reading.segment + 1),
                                    toFloats(reading.orientation), toFloats(reading.freeAcceleration),
                                    toFloats(reading.acceleration), toFloats(reading.angularVelocity),
                                    toFloats(reading.magneticField)});
    }
}

void perform(const Subject& subject, wire::CentreOfMass& message) {
    const auto& centre = subject.moment.centreOfMass;
    message.position = toFloats(centre.position);
    message.hasDerivatives = subject.dialect.sendsMassDerivatives;
    if (message.hasDerivatives) {
        message.velocity = toFloats(centre.velocity);
        message.acceleration = toFloats(centre.acceleration);
    }
}

void perform(const Subject& subject, wire::TimeCode& message) {
    constexpr std::uint64_t kMsPerDay = 86'400'000;
    const std::uint64_t ms = subject.timeOfDayMs % kMsPerDay;
    putDigits(ms / 3'600'000, 0, 2, message.text);
    putDigits(ms / 60'000 % 60, 3, 2, message.text);
    putDigits(ms / 1000 % 60, 6, 2, message.text);
    putDigits(ms % 1000, 9, 3, message.text);
    message.hasLengthPrefix = subject.dialect.prefixesTimeCode;
}

wire::ScaleInformation scaleInformation(const Character& character) {
    const model::ReferenceBody& body = character.body();
    const auto scale = static_cast<float>(body.stature / model::kReferenceStature);
    wire::ScaleInformation message;
    for (std::size_t index = 0; index < model::kBodySegmentCount; ++index) {
        const Vector3d offset = body.origins[index] - model::referenceOrigins()[index];
        message.segments.push_back({static_cast<std::uint32_t>(index + 1),
                                    toFloats(offset),
                                    {scale, 0.0F, 0.0F, 0.0F, scale, 0.0F, 0.0F, 0.0F, scale}});
    }
    return message;
}

wire::PropInformation propInformation(const Character& character, const MessageDialect& dialect) {
    const model::SegmentLayout& layout = character.layout();
    wire::PropInformation message;
    for (int prop = 0; prop < layout.props; ++prop) {
        message.props.push_back(
            {segmentId(layout, layout.body + prop, dialect), std::string(propName(prop))});
    }
    return message;
}

wire::MetaData metaData(const Character& character, int characterCount, const MessageDialect& dialect) {
    const Identity& identity = character.identity();
    wire::MetaData message;
    message.hasLengthPrefix = dialect.prefixesMetaData;
    message.text = "color:" + identity.colour + "\n";
    if (dialect.sendsRealTags) {
        message.text += "count:" + std::to_string(characterCount) + "\n";
    }
    message.text += "name:" + identity.name + "\n";
    if (dialect.sendsRealTags) {
        message.text += "timeOffset:0\n";
    }
    message.text += "xmid:" + identity.suitId + "\n";
    return message;
}

std::vector<wire::NullPose> nullPoseParts(const Character& character) {
    const model::SegmentLayout& layout = character.layout();
    const std::vector<Vector3d> origins = character.nullPose();
    std::vector<wire::NullPose> parts(1);
    for (int position = 0; position < layout.count(); ++position) {
        const bool isProp = model::placeOf(layout, position)->kind == model::SegmentKind::Prop;
        const std::string_view name =
            isProp ? propName(position - layout.body) : model::segmentName(layout, position);
        parts.front().segments.push_back(
            {std::string(name), toFloats(origins[static_cast<std::size_t>(position)])});
    }
    // 30 points of up to 48 bytes stay within an Ethernet frame.
    constexpr std::size_t kPointsPerPart = 30;
    const auto points = model::anatomicalPoints();
    for (std::size_t place = 0; place < points.size(); ++place) {
        if (place % kPointsPerPart == 0) {
            parts.emplace_back();
        }
        const model::AnatomicalPoint& point = points[place];
        parts.back().points.push_back({static_cast<std::uint16_t>(point.segment + 1),
                                       static_cast<std::uint16_t>(point.localId), std::string(point.name), 0,
                                       toFloats(character.body().points[place])});
    }
    return parts;
}

} // namespace posewire::performer
