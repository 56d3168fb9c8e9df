// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/mvnx/frame.h"

#include "core/model/body/spaces.h"
#include "core/model/text.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace posewire::mvnx {
namespace {

using Result = tl::expected<void, log::FileError>;

struct Element {
    std::string_view name;
    std::size_t (*count)(const Subject& subject);
    std::size_t size; ///< numbers for each
};

constexpr auto kSegments = [](const Subject& subject) { return subject.segments.size(); };
constexpr auto kSensors = [](const Subject& subject) { return subject.sensors.size(); };
constexpr auto kJoints = [](const Subject& subject) { return subject.joints.size(); };
constexpr auto kErgonomicAngles = [](const Subject& subject) { return subject.ergonomicAngles.size(); };
constexpr auto kOne = [](const Subject& /*subject*/) { return std::size_t{1}; };

/// In the order of Frame::Field.
constexpr std::array<Element, Frame::FieldCount> kElements{{
    {"orientation", kSegments, 4},
    {"position", kSegments, 3},
    {"velocity", kSegments, 3},
    {"acceleration", kSegments, 3},
    {"angularVelocity", kSegments, 3},
    {"angularAcceleration", kSegments, 3},
    {"sensorFreeAcceleration", kSensors, 3},
    {"sensorAcceleration", kSensors, 3},
    {"sensorAngularVelocity", kSensors, 3},
    {"sensorMagneticField", kSensors, 3},
    {"sensorOrientation", kSensors, 4},
    {"jointAngle", kJoints, 3},
    {"jointAngleErgo", kErgonomicAngles, 3},
    {"centerOfMass", kOne, 3},
}};
constexpr std::size_t kMassWithDerivatives = 9; ///< numbers: position, velocity, acceleration

} // namespace

Result Frame::begins(const XmlReader& xml, double rateHz) {
    for (std::vector<float>& field : m_fields) {
        field.clear();
    }
    m_type = xml.attribute("type").substr(0, 16);
    if (!isNormal()) {
        return {};
    }
    const std::string_view written = xml.attribute("index");
    const std::int64_t next = m_hasBegun ? std::int64_t{index} + 1 : 0;
    const std::int64_t number = written.empty() ? next : numberIn<std::int64_t>(written).value_or(-1);
    if (number < next || number > INT32_MAX) {
        return tl::unexpected(xml.damage("a frame with the index \"" + std::string(written.substr(0, 32)) +
                                         "\", not " + std::to_string(next) + " or more"));
    }
    m_hasBegun = true;
    index = static_cast<std::uint32_t>(number);
    const auto byRate = static_cast<std::int64_t>(std::llround(1000.0 * static_cast<double>(index) / rateHz));
    timeMs = static_cast<std::uint32_t>(numberIn<std::int64_t>(xml.attribute("time")).value_or(byRate));
    epochMs = numberIn<std::int64_t>(xml.attribute("ms"));
    m_timeCode = xml.attribute("tc").substr(0, 16);
    return {};
}

Result Frame::ends(const XmlReader& xml, const Subject& subject) {
    const auto* const element = std::find_if(kElements.begin(), kElements.end(),
                                             [&xml](const Element& one) { return one.name == xml.name(); });
    if (element == kElements.end()) {
        return {};
    }
    std::vector<float>& field = m_fields[static_cast<std::size_t>(element - kElements.begin())];
    const std::size_t need = element->size * element->count(subject);
    const bool isMass = element - kElements.begin() == CentreOfMass;
    if (auto read = readNumbers(xml, isMass ? kMassWithDerivatives : need, field); !read) {
        return read;
    }
    if (field.size() < need) {
        return tl::unexpected(xml.damage("<" + std::string(xml.name()) + "> has " +
                                         std::to_string(field.size()) + " numbers, not " +
                                         std::to_string(need)));
    }
    return {};
}

bool Frame::isNullPose() const {
    const std::span<const float> turns = field(Orientation);
    bool isTurned = turns.empty();
    for (std::size_t i = 0; i < turns.size(); ++i) {
        isTurned = isTurned || std::abs(turns[i] - (i % 4 == 0 ? 1.0F : 0.0F)) > 1e-6F;
    }
    return !isNormal() && has({Position}) && (m_type == "identity" || m_type == "npose" || !isTurned);
}

bool Frame::has(std::initializer_list<Field> fields) const {
    return std::all_of(fields.begin(), fields.end(),
                       [this](Field which) { return !m_fields[which].empty(); });
}

template <std::size_t Size>
std::array<float, Size> Frame::at(Field which, std::size_t item) const {
    std::array<float, Size> values{};
    const std::vector<float>& field = m_fields[which];
    if ((item + 1) * Size <= field.size()) {
        std::copy_n(field.begin() + static_cast<std::ptrdiff_t>(item * Size), Size, values.begin());
    }
    return values;
}

void Frame::put(const Subject& subject, std::uint8_t character, const TakeDatagram& take) {
    const auto isOfBody = [](const Subject::Segment& segment) { return segment.id <= 23; };
    const auto body = std::count_if(subject.segments.begin(), subject.segments.end(), isOfBody);
    m_datagram.header.sampleCounter = index;
    m_datagram.header.timeCode = timeMs;
    m_datagram.header.character = character;
    m_datagram.header.bodySegments = static_cast<std::uint8_t>(body);
    m_datagram.header.props =
        static_cast<std::uint8_t>(subject.segments.size() - static_cast<std::size_t>(body));
    wire::completeHeader(m_datagram, wire::HeaderEra::Counted);
    if (wire::encodeInto(m_datagram, m_bytes)) {
        take(m_bytes);
    }
}

void Frame::send(const Subject& subject, std::uint8_t character, const TakeDatagram& take) {
    const auto putBody = [&](wire::Body body) {
        m_datagram.body = std::move(body);
        put(subject, character, take);
    };
    m_datagram.header.datagramCounter = wire::Header::kLast;
    wire::PoseQuaternion pose;
    wire::LinearKinematics linear;
    wire::AngularKinematics angular;
    for (std::size_t i = 0; i < subject.segments.size(); ++i) {
        const std::uint32_t id = subject.segments[i].id;
        const auto place = at<3>(Position, i);
        const auto turn = at<4>(Orientation, i);
        pose.segments.push_back({id, place, turn});
        linear.segments.push_back({id, place, at<3>(Velocity, i), at<3>(Acceleration, i)});
        angular.segments.push_back({id, turn, at<3>(AngularVelocity, i), at<3>(AngularAcceleration, i)});
    }
    if (const auto code = timeCode(subject.rateHz)) {
        putBody(*code);
    }
    if (has({Orientation, Position})) {
        putBody(std::move(pose));
    }
    if (has({JointAngle})) {
        putBody(jointAngles(subject));
    }
    if (has({Position, Velocity, Acceleration})) {
        putBody(std::move(linear));
    }
    if (has({Orientation, AngularVelocity, AngularAcceleration})) {
        putBody(std::move(angular));
    }
    if (has({SensorOrientation}) && (has({SensorFreeAcceleration}) || has({SensorAcceleration}))) {
        putBody(trackers(subject));
    }
    if (has({CentreOfMass})) {
        const bool hasDerivatives = field(CentreOfMass).size() == kMassWithDerivatives;
        putBody(wire::CentreOfMass{hasDerivatives, at<3>(CentreOfMass, 0), at<3>(CentreOfMass, 1),
                                   at<3>(CentreOfMass, 2)});
    }
}

wire::JointAngles Frame::jointAngles(const Subject& subject) const {
    wire::JointAngles message;
    for (std::size_t i = 0; i < subject.joints.size(); ++i) {
        message.joints.push_back({subject.joints[i].parent, subject.joints[i].child, at<3>(JointAngle, i)});
    }
    for (std::size_t i = 0; has({JointAngleErgo}) && i < subject.ergonomicAngles.size(); ++i) {
        const Subject::Joint& joint = subject.ergonomicAngles[i];
        message.joints.push_back({joint.parent, joint.child, at<3>(JointAngleErgo, i)});
    }
    return message;
}

/// Files of version 3 have the specific force in the sensor's frame, from which the free acceleration
/// follows.
wire::TrackerKinematics Frame::trackers(const Subject& subject) const {
    constexpr double kGravity = 9.81;
    wire::TrackerKinematics message;
    message.hasInertialData = has({SensorAcceleration, SensorAngularVelocity});
    for (std::size_t i = 0; i < subject.sensors.size(); ++i) {
        wire::Tracker tracker{
            subject.sensors[i],           at<4>(SensorOrientation, i),     at<3>(SensorFreeAcceleration, i),
            at<3>(SensorAcceleration, i), at<3>(SensorAngularVelocity, i), at<3>(SensorMagneticField, i)};
        if (!has({SensorFreeAcceleration})) {
            const Eigen::Vector3d force =
                model::normalizedOrIdentity(model::toQuaternion(tracker.orientation)) *
                model::toVector(tracker.acceleration);
            tracker.freeAcceleration =
                model::toFloats(Eigen::Vector3d(force - kGravity * Eigen::Vector3d::UnitZ()));
        }
        message.trackers.push_back(tracker);
    }
    return message;
}

/// MVNX counts frames in the second behind the last colon, type 25 milliseconds.
std::optional<wire::TimeCode> Frame::timeCode(double rateHz) const {
    std::array<std::int64_t, 4> parts{};
    std::size_t count = 0;
    for (std::string_view rest = m_timeCode; !rest.empty() && count < parts.size(); ++count) {
        const std::size_t end = std::min(rest.find_first_of(":;."), rest.size());
        const auto part = numberIn<std::int64_t>(rest.substr(0, end));
        if (!part || *part < 0 || *part > 999) {
            return std::nullopt;
        }
        parts[count] = *part;
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    if (count != parts.size() || parts[0] > 23 || parts[1] > 59 || parts[2] > 59) {
        return std::nullopt;
    }
    parts[3] =
        std::min<std::int64_t>(999, std::llround(std::ceil(1000.0 * static_cast<double>(parts[3]) / rateHz)));
    using model::padded;
    const std::string text = padded(parts[0], 2) + ':' + padded(parts[1], 2) + ':' + padded(parts[2], 2) +
                             '.' + padded(parts[3], 3);
    wire::TimeCode code;
    std::copy(text.begin(), text.end(), code.text.begin());
    return code;
}

void Frame::sendDescription(const Subject& subject, std::uint8_t character, std::span<const float> nullPose,
                            const TakeDatagram& take) {
    m_datagram.header.datagramCounter = wire::Header::kLast;
    wire::MetaData meta;
    meta.text =
        (subject.colour.starts_with('#') ? "color:" + subject.colour.substr(1) + "\n" : std::string()) +
        "name:" + subject.name + "\n";
    m_datagram.body = std::move(meta);
    put(subject, character, take);
    if (nullPose.size() != 3 * subject.segments.size()) {
        return;
    }
    constexpr std::size_t kPointsPerPart = 24; // of up to 24 bytes and a name: within an Ethernet frame
    wire::NullPose part;
    for (std::size_t i = 0; i < subject.segments.size(); ++i) {
        part.segments.push_back(
            {subject.segments[i].name, {nullPose[3 * i], nullPose[3 * i + 1], nullPose[3 * i + 2]}});
    }
    std::span<const wire::NullPosePoint> points = subject.points;
    for (std::uint8_t place = 0; place == 0 || !part.points.empty(); ++place) {
        const bool isLast = points.empty();
        m_datagram.body = std::exchange(part, {});
        m_datagram.header.datagramCounter =
            static_cast<std::uint8_t>(place | (isLast ? wire::Header::kLast : 0U));
        put(subject, character, take);
        const auto next = points.first(std::min(kPointsPerPart, points.size()));
        part.points.assign(next.begin(), next.end());
        points = points.subspan(next.size());
    }
}

} // namespace posewire::mvnx
