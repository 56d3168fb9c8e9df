// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/overlays.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/theme.h"
#include "core/model/body/item_names.h"
#include "core/model/body/pose_solver.h"
#include "core/model/session/messages.h"

#include <algorithm>
#include <cmath>

namespace posewire::gui {

void addOverlays(const Overlays& on, const OverlaySubject& subject, SceneFrame& frame) {
    for (const OverlayEntry& entry : kOverlayTable) {
        if (on.has(entry.overlay)) {
            entry.draw(subject, frame);
        }
    }
}

void addWay(const std::vector<glm::vec3>& places, const glm::vec4& ink, float width, SceneFrame& frame) {
    for (std::size_t i = 1; i < places.size(); ++i) {
        glm::vec4 faded = ink;
        faded.a *= static_cast<float>(i) / static_cast<float>(places.size());
        frame.lines.push_back({places[i - 1], places[i], faded, width});
    }
}

namespace {

constexpr std::size_t kBody = model::kBodySegmentCount;

/// The child that a segment points to; -1 for none, and for those with several.
int onlyChild(int segment) {
    int child = -1;
    int count = 0;
    for (std::size_t i = 0; i < kBody; ++i) {
        if (model::bodySegments()[i].parent == segment) {
            child = static_cast<int>(i);
            ++count;
        }
    }
    return count == 1 ? child : -1;
}

void drawArc(const OverlaySubject& subject, int segment, SceneFrame& frame) {
    constexpr float kRadius = 0.13F;
    constexpr int kSteps = 16;
    const int child = onlyChild(segment);
    const auto joint = jointReading(subject, segment);
    if (!joint) {
        return;
    }
    const QString text = QStringLiteral("%1 °").arg(joint->degrees[2], 0, 'f', 1);
    const int parent = model::bodySegments()[static_cast<std::size_t>(segment)].parent;
    const auto place = [&](int one) {
        return pointOf(subject.pose.segments[static_cast<std::size_t>(one)].position);
    };
    const glm::vec3 at = place(segment);
    if (child < 0) { // the end of a limb, or where it branches: no bone to turn to
        frame.texts.push_back({at, text, theme().warning});
        return;
    }
    const glm::vec3 along = glm::normalize(at - place(parent));
    const glm::vec3 bone = glm::normalize(place(child) - at);
    const glm::vec4 ink = inkOf(theme().warning, subject.strength);
    frame.lines.push_back({at, at + 1.25F * kRadius * along, ink, 1.2F});
    frame.lines.push_back({at, at + 1.25F * kRadius * bone, ink, 1.2F});
    const float angle = std::acos(std::clamp(glm::dot(along, bone), -1.0F, 1.0F));
    glm::vec3 before = at + kRadius * along;
    for (int step = 1; step <= kSteps && angle > 0.01F; ++step) {
        const float share = static_cast<float>(step) / kSteps;
        const glm::vec3 way = (std::sin((1 - share) * angle) * along + std::sin(share * angle) * bone) /
                              std::max(std::sin(angle), 1e-3F);
        const glm::vec3 next = at + kRadius * way;
        frame.lines.push_back({before, next, ink, 2.0F});
        before = next;
    }
    frame.texts.push_back(
        {at + 1.4F * kRadius * glm::normalize(along + bone + glm::vec3(0, 0, 1e-3F)), text, theme().warning});
}

constexpr float kOnFloor = 0.004F; ///< metres: above the lines of the grid

glm::vec3 onFloor(const glm::vec3& place) {
    return {place.x, place.y, kOnFloor};
}

template <class Vector>
void drawVectors(const OverlaySubject& subject, const QColor& colour, double scale, Vector vector,
                 SceneFrame& frame) {
    const auto* sent = freshBody<wire::LinearKinematics>(subject);
    if (sent == nullptr) {
        return;
    }
    const double unit = model::metresPer(unitOf(subject, wire::LinearKinematics::kType));
    const std::size_t count = std::min(sent->segments.size(), subject.pose.segments.size());
    for (std::size_t i = 0; i < count; ++i) {
        const Eigen::Vector3d way = scale * unit * model::toVector(vector(sent->segments[i]));
        if (subject.pose.isPresent(i) && way.allFinite() && way.norm() > 0.005) {
            const glm::vec3 from = pointOf(subject.pose.segments[i].position);
            const glm::vec3 to = from + pointOf(way);
            frame.lines.push_back({from, to, inkOf(colour, subject.strength), 2.0F});
            frame.points.push_back({to, inkOf(colour, subject.strength), 4.0F});
        }
    }
}

/// Position of a segment in a message of positions, as sent; nothing for other messages.
std::optional<Eigen::Vector3d> positionIn(const wire::Body& body, std::size_t segment,
                                          model::LengthUnit unit) {
    std::optional<Eigen::Vector3d> place;
    if (const auto* pose = std::get_if<wire::PoseQuaternion>(&body);
        pose && segment < pose->segments.size()) {
        place = model::toVector(pose->segments[segment].position) * model::metresPer(unit);
    } else if (const auto* euler = std::get_if<wire::PoseEuler>(&body);
               euler && segment < euler->segments.size()) {
        place = model::poseFromEuler(euler->segments[segment], unit).position;
    } else if (const auto* linear = std::get_if<wire::LinearKinematics>(&body);
               linear && segment < linear->segments.size()) {
        place = model::toVector(linear->segments[segment].position) * model::metresPer(unit);
    }
    return place && place->allFinite() ? place : std::nullopt;
}

} // namespace

void drawSegmentNames(const OverlaySubject& subject, SceneFrame& frame) {
    frame.hasNamesLeftOut = frame.hasNamesLeftOut || !subject.isAlone;
    for (std::size_t i = 0; subject.isAlone && i < subject.pose.segments.size(); ++i) {
        if (i < kBody + static_cast<std::size_t>(subject.pose.layout.props) && subject.pose.isPresent(i)) {
            const auto name = model::segmentTitle(subject.pose.layout, static_cast<int>(i));
            frame.texts.push_back(
                {pointOf(subject.pose.segments[i].position), fromUtf8(name), theme().text, false, true});
        }
    }
}

void drawJointAngles(const OverlaySubject& subject, SceneFrame& frame) {
    if (subject.segment >= 0 && subject.segment < model::kBodySegmentCount) {
        drawArc(subject, subject.segment, frame);
        return;
    }
    for (const int segment : {model::segment::kRightForeArm, model::segment::kLeftForeArm,
                              model::segment::kRightLowerLeg, model::segment::kLeftLowerLeg}) {
        drawArc(subject, segment, frame);
    }
}

void drawMarkers(const OverlaySubject& subject, SceneFrame& frame) {
    const auto* sent = freshBody<wire::PointPositions>(subject);
    if (sent == nullptr) {
        return;
    }
    const wire::Datagram& datagram = freshMessage(subject, wire::PointPositions::kType)->datagram;
    const model::LengthUnit unit = unitOf(subject, wire::PointPositions::kType);
    const std::size_t markers = model::countMarkers(*sent); // the tags behind them are drawn anyway
    frame.hasNamesLeftOut = frame.hasNamesLeftOut || !subject.isAlone;
    for (std::size_t i = 0; i < markers; ++i) {
        const wire::Point& point = sent->points[i];
        const glm::vec3 place = pointOf(model::pointFromYUp(point.position, unit) + subject.pose.moved);
        frame.points.push_back({place, inkOf(theme().text, subject.strength), 6.0F});
        if (subject.isAlone) {
            const QString name = fromUtf8(model::itemName(datagram, i));
            frame.texts.push_back(
                {place, name.isEmpty() ? QString::number(point.id) : name, theme().text, false, true});
        }
    }
}

void drawTrackers(const OverlaySubject& subject, SceneFrame& frame) {
    constexpr double kAcceleration = 0.01; // metres for 1 m/s²
    constexpr double kField = 0.12;        // metres for the field of calibration
    constexpr double kOut = 0.09;          // metres from the middle of the bone, out of the flesh
    const auto* sent = freshBody<wire::TrackerKinematics>(subject);
    if (sent == nullptr) {
        return;
    }
    for (const wire::Tracker& tracker : sent->trackers) {
        const std::size_t segment = tracker.id - std::size_t{1};
        if (tracker.id < 1 || tracker.id > model::kBodySegmentCount || !subject.pose.isPresent(segment)) {
            continue;
        }
        const model::SegmentPose& body = subject.pose.segments[segment];
        const Eigen::Vector3d out = body.orientation * Eigen::Vector3d(kOut, 0, 0);
        const Eigen::Quaterniond turn = model::normalizedOrIdentity(model::toQuaternion(tracker.orientation));
        const glm::vec3 at = pointOf(body.position + out);
        frame.axes.push_back({at, turnOf(turn), 0.06F, subject.strength});
        frame.points.push_back({at, inkOf(theme().text, subject.strength), 5.0F});
        const Eigen::Vector3d push = kAcceleration * model::toVector(tracker.freeAcceleration);
        const Eigen::Vector3d field = kField * (turn * model::toVector(tracker.magneticField));
        if (push.allFinite() && push.norm() > 0.003) {
            frame.lines.push_back({at, at + pointOf(push), inkOf(theme().error, subject.strength), 2.0F});
        }
        if (field.allFinite()) {
            frame.lines.push_back(
                {at, at + pointOf(field), inkOf(theme().plotFourth, 0.8F * subject.strength), 1.4F});
        }
    }
}

void drawCentreOfMass(const OverlaySubject& subject, SceneFrame& frame) {
    constexpr std::size_t kMost = 720; // 3 s at 240 Hz
    constexpr log::Duration kBack = std::chrono::seconds(3);
    if (freshMessage(subject, wire::CentreOfMass::kType) == nullptr) {
        return;
    }
    const double unit = model::metresPer(unitOf(subject, wire::CentreOfMass::kType));
    std::vector<glm::vec3> way;
    const log::StreamKey stream{subject.key.sender, subject.key.character, wire::CentreOfMass::kType};
    subject.session.messages().visit(
        stream, subject.session.cursorStamp() - kBack, kMost, [&](const model::Message& one) {
            const auto* sent = std::get_if<wire::CentreOfMass>(&one.datagram.body);
            const Eigen::Vector3d place = unit * model::toVector(sent->position) + subject.pose.moved;
            if (place.allFinite() && (way.empty() || glm::distance(way.back(), pointOf(place)) > 0.01F)) {
                way.push_back(pointOf(place));
            }
        });
    const auto* newest =
        std::get_if<wire::CentreOfMass>(&freshMessage(subject, wire::CentreOfMass::kType)->datagram.body);
    const glm::vec3 centre = pointOf(unit * model::toVector(newest->position) + subject.pose.moved);
    const glm::vec4 ink = inkOf(theme().warning, subject.strength);
    addWay(way, ink, 1.6F, frame);
    for (glm::vec3& place : way) {
        place = onFloor(place);
    }
    addWay(way, inkOf(theme().warning, 0.6F * subject.strength), 1.4F, frame);
    frame.lines.push_back({centre, onFloor(centre), inkOf(theme().warning, 0.7F * subject.strength), 1.2F});
    frame.points.push_back({onFloor(centre), ink, 6.0F});
    frame.points.push_back({centre, ink, 10.0F, 1.0F});
}

void drawContacts(const OverlaySubject& subject, SceneFrame& frame) {
    const auto contacts =
        model::soleContacts(subject.pose, subject.session.messages().bodyOrigins(subject.key));
    const glm::vec4 ink = inkOf(theme().good, subject.strength);
    for (const Eigen::Vector3d& contact : contacts) {
        frame.points.push_back({onFloor(pointOf(contact)), ink, 6.0F, 1.0F});
    }
    const auto polygon = model::supportPolygon(contacts);
    for (std::size_t i = 0; polygon.size() > 1 && i < polygon.size(); ++i) {
        frame.lines.push_back(
            {onFloor(pointOf(polygon[i])), onFloor(pointOf(polygon[(i + 1) % polygon.size()])), ink, 1.8F});
    }
}

void drawVelocities(const OverlaySubject& subject, SceneFrame& frame) {
    drawVectors(
        subject, theme().accent, 0.1, [](const wire::LinearSegment& item) { return item.velocity; }, frame);
}

void drawAccelerations(const OverlaySubject& subject, SceneFrame& frame) {
    drawVectors(
        subject, theme().error, 0.01, [](const wire::LinearSegment& item) { return item.acceleration; },
        frame);
}

void drawTrails(const OverlaySubject& subject, SceneFrame& frame) {
    constexpr log::Duration kBack = std::chrono::milliseconds(1500);
    constexpr std::size_t kMost = 360; // 1.5 s at 240 Hz
    std::vector<std::size_t> segments{model::segment::kHead, model::segment::kRightHand,
                                      model::segment::kLeftHand, model::segment::kRightToe,
                                      model::segment::kLeftToe};
    if (subject.segment >= 0) {
        segments.assign(1, static_cast<std::size_t>(subject.segment));
    }
    const std::uint8_t type = subject.pose.type;
    const model::LengthUnit unit = unitOf(subject, type);
    std::vector<std::vector<glm::vec3>> ways(segments.size());
    subject.session.messages().visit(
        {subject.key.sender, subject.key.character, type}, subject.session.cursorStamp() - kBack, kMost,
        [&](const model::Message& one) {
            for (std::size_t i = 0; i < segments.size(); ++i) {
                const auto place = positionIn(one.datagram.body, segments[i], unit);
                const auto at = place ? pointOf(*place + subject.pose.moved) : glm::vec3();
                if (place && (ways[i].empty() || glm::distance(ways[i].back(), at) > 0.01F)) {
                    ways[i].push_back(at);
                }
            }
        });
    for (const auto& way : ways) {
        addWay(way, glm::vec4(subject.colour, subject.strength), 2.2F, frame);
    }
}

} // namespace posewire::gui
