// SPDX-License-Identifier: MIT
#include "core/model/body/null_pose_findings.h"
#include "core/model/body/null_pose_measures.h"
#include "core/model/body/points.h"
#include "core/model/text.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace posewire::model {
namespace {

using Eigen::Vector3d;
using namespace segment;
using Findings = std::vector<NullPoseFinding>;

constexpr double kLeastStature = 0.4;    ///< an infant
constexpr double kGreatestStature = 2.6; ///< nobody was taller than 2.72 m
constexpr double kFloorTolerance = 0.03; ///< soles are 13 to 15 mm below the ball of the foot, which is at 0
constexpr double kAboveFloor = 0.10;
constexpr double kNoise = 0.001;
constexpr double kPointTolerance = 0.005;

std::string nameOf(int bodySegment) {
    return std::string(bodySegments()[static_cast<std::size_t>(bodySegment)].displayName);
}

bool isStature(double metres) {
    return metres >= kLeastStature && metres <= kGreatestStature;
}

/// The largest extent of the segments along each axis.
Vector3d extentOf(const NullPose& pose) {
    Eigen::AlignedBox3d box;
    for (const NullPose::Segment& segment : pose.segments) {
        if (segment.position.allFinite()) {
            box.extend(segment.position);
        }
    }
    return box.isEmpty() ? Vector3d(Vector3d::Zero()) : Vector3d(box.sizes());
}

/// True where the size is no person's: what else is found about places would only repeat it.
bool findSize(const NullPose& pose, const NullPoseMeasures& measures, Findings& findings) {
    const double size =
        measures.height && *measures.height > 0 ? *measures.height : extentOf(pose).maxCoeff();
    if (isStature(size) || size <= 0) {
        return false;
    }
    const std::string found = "The body is " + fixedText(size, size < 10 ? 2 : 0) + " units tall";
    for (const auto& [unit, factor] :
         {std::pair{"centimetres", 0.01}, std::pair{"millimetres", 0.001}, std::pair{"inches", 0.0254}}) {
        if (size > kGreatestStature && isStature(size * factor)) {
            findings.push_back(
                {NullPoseFault::Unit, Severity::Error, -1,
                 found + ": that looks like " + unit + " (" + fixedText(size * factor, 2) +
                     " m); the specification's unit is the metre.",
                 "Receivers draw a giant. Set the sender's unit, or scale by " + fixedText(factor, 4) + "."});
            return true;
        }
    }
    findings.push_back({NullPoseFault::Stature, Severity::Warning, -1,
                        "The body is " + fixedText(size, 2) + " m tall, which nobody is.",
                        "Body dimensions were entered wrongly, or the sender is not MVN."});
    return size > kGreatestStature;
}

/// True where the body does not stand along z.
bool findUp(const NullPose& pose, const BodyPlaces& places, Findings& findings) {
    const auto pelvis = originOf(pose, places, kPelvis);
    const auto head = originOf(pose, places, kHead);
    if (!pelvis || !head) {
        return false;
    }
    const Vector3d up = *head - *pelvis;
    if (up.norm() < kNoise || up.z() > 0.7 * up.norm()) {
        return false;
    }
    Eigen::Index axis = 0;
    up.cwiseAbs().maxCoeff(&axis);
    const std::string name = std::string(up[axis] < 0 ? "−" : "") + "xyz"[axis];
    findings.push_back({NullPoseFault::AxisUp, Severity::Error, kHead,
                        "The body stands along " + name + "; the specification's null pose stands along z.",
                        axis == 1
                            ? "The sender writes Y-up data. Figures made from this message lie on the floor."
                            : "Figures made from this message lie on the floor or stand on their heads."});
    return true;
}

void findMirror(const NullPose& pose, const BodyPlaces& places, Findings& findings) {
    int exchanged = 0;
    int judged = 0;
    int first = -1;
    for (const Segment& segment : bodySegments()) {
        const auto origin = originOf(pose, places, segment.id - 1);
        if (segment.side == Side::Centre || !origin || std::abs(origin->y()) < kNoise) {
            continue;
        }
        ++judged;
        if ((origin->y() > 0) == (segment.side == Side::Right)) {
            ++exchanged;
            first = first < 0 ? segment.id - 1 : first;
        }
    }
    if (exchanged == 0) {
        return;
    }
    const bool isWhole = exchanged == judged;
    findings.push_back(
        {NullPoseFault::Mirrored, Severity::Error, first,
         isWhole
             ? "Left and right are exchanged: the right arm and leg lie towards +y, where the left belongs."
             : std::to_string(exchanged) + " of " + std::to_string(judged) +
                   " segments lie on the wrong side, " + nameOf(first) + " first.",
         isWhole ? "The body is mirrored, or looks towards −x. Figures are twisted where poses are not "
                   "mirrored too."
                 : "Figures are torn at these segments."});
}

void findFloor(const NullPose& pose, const BodyPlaces& places, Findings& findings) {
    const auto pelvis = originOf(pose, places, kPelvis);
    std::vector<std::string> below;
    int lowest = -1;
    double depth = -kFloorTolerance;
    double stand = std::numeric_limits<double>::infinity();
    for (int index = 0; index < kBodySegmentCount; ++index) {
        const auto origin = originOf(pose, places, index);
        if (!origin) {
            continue;
        }
        stand = std::min(stand, origin->z());
        if (origin->z() < -kFloorTolerance) {
            below.push_back(nameOf(index) + " " + millimetresText(origin->z()));
        }
        if (origin->z() < depth) {
            depth = origin->z();
            lowest = index;
        }
    }
    if (!below.empty() && pelvis && pelvis->norm() < kFloorTolerance) {
        findings.push_back(
            {NullPoseFault::BelowFloor, Severity::Note, lowest,
             "The pelvis is at the origin and the feet are " + metresText(-depth) + " below it.",
             "So upper-body configurations send it. Ghost and figure are put on the floor with their "
             "lowest point."});
    } else if (!below.empty()) {
        findings.push_back(
            {NullPoseFault::BelowFloor, Severity::Warning, lowest,
             counted(below.size(), "segment") + " below the floor: " + listed(below) + ".",
             "In MVN's null pose the balls of the feet are at z = 0. Meshes fitted to it sink in."});
    } else if (std::isfinite(stand) && stand > kAboveFloor) {
        findings.push_back(
            {NullPoseFault::AboveFloor, Severity::Note, -1,
             "The body hangs " + metresText(stand) + " above the floor.",
             "In MVN's null pose the balls of the feet are at z = 0. Meshes fitted to it float."});
    }
}

void findAsymmetry(const NullPoseMeasures& measures, Findings& findings) {
    std::vector<std::string> uneven;
    int first = -1;
    for (const SegmentLength& length : measures.lengths) {
        if (length.isAsymmetric()) {
            first = first < 0 ? length.left : first;
            uneven.push_back(std::string(length.name) + " (left " + millimetresText(*length.difference()) +
                             ")");
        }
    }
    if (!uneven.empty()) {
        findings.push_back(
            {NullPoseFault::Asymmetric, Severity::Note, first,
             "Left and right differ by 5 mm or more: " + listed(uneven) + ".",
             "MVN measures one side for both. Someone entered the other side by hand, or the body was "
             "edited."});
    }
}

std::string idText(const NullPose::Point& point) {
    return std::to_string(point.segment) + "." + std::to_string(point.id) + " " + point.name.shown();
}

void findPointIds(const NullPose& pose, Findings& findings) {
    const auto count = static_cast<int>(pose.segments.size());
    std::set<std::pair<int, int>> ids;
    std::vector<std::string> lost;
    std::vector<std::string> twice;
    for (const NullPose::Point& point : pose.points) {
        if (point.segment < 1 || point.segment > count) {
            lost.push_back(idText(point));
        }
        if (!ids.insert({point.segment, point.id}).second) {
            twice.push_back(idText(point));
        }
    }
    // As long as segments are on their way, it is not known where points belong.
    if (!lost.empty() && count > 0) {
        findings.push_back({NullPoseFault::PointWithoutSegment, Severity::Error, -1,
                            counted(lost.size(), "point") + " on segments that do not exist: " +
                                listed(lost) + "; there are " + std::to_string(count) + ".",
                            "Markers and meshes cannot use them; they are in no picture."});
    }
    if (!twice.empty()) {
        findings.push_back(
            {NullPoseFault::PointTwice, Severity::Warning, -1,
             counted(twice.size(), "point ID") + " given twice: " + listed(twice) + ".",
             "Joint angles and markers name points by these IDs: which one is meant is open."});
    }
}

void findPointNames(const NullPose& pose, Findings& findings) {
    std::vector<std::string> other;
    for (const NullPose::Point& point : pose.points) {
        const AnatomicalPoint* known = findPoint(point.segment - 1, point.id);
        if (known != nullptr && !(point.name == known->name)) {
            other.push_back(idText(point) + " (elsewhere " + std::string(known->name) + ")");
        }
    }
    if (!other.empty()) {
        findings.push_back(
            {NullPoseFault::PointName, Severity::Note, -1,
             (other.size() == 1 ? "One point has an unfamiliar name: "
                                : grouped(other.size()) + " points have unfamiliar names: ") +
                 listed(other) + ".",
             "The point list may be from another version. Check the IDs before using points by ID."});
    }
}

/// A joint is a point of the parent and the first point of the child: both must be at the child's origin.
void findJoints(const NullPose& pose, Findings& findings) {
    const BodyPlaces places = bodyPlaces(pose);
    // Whatever the unit, it is a share of the body.
    const double tolerance =
        std::max(kPointTolerance, kPointTolerance / kGreatestStature * extentOf(pose).maxCoeff());
    std::map<int, std::string_view> joints;
    for (const NullPose::Point& point : pose.points) {
        if (point.id == 1) {
            joints.emplace(point.segment, point.name.exact());
        }
    }
    std::vector<std::string> apart;
    int first = -1;
    for (const auto& [id, joint] : joints) {
        const int parentIndex =
            id >= 1 && id <= kBodySegmentCount ? bodySegments()[static_cast<std::size_t>(id - 1)].parent : -1;
        const auto child = parentIndex < 0 ? std::nullopt : originOf(pose, places, id - 1);
        const auto parent = parentIndex < 0 ? std::nullopt : originOf(pose, places, parentIndex);
        const auto point = std::ranges::find_if(pose.points, [&, joint = joint](const NullPose::Point& each) {
            return each.segment == parentIndex + 1 && each.name == joint;
        });
        const double distance =
            child && parent && point != pose.points.end() ? (*parent + point->position - *child).norm() : 0.0;
        if (distance >= tolerance) {
            first = first < 0 ? id - 1 : first;
            apart.push_back(shownText(joint) + " by " + fixedText(distance * 1000.0, 0) + " mm");
        }
    }
    if (!apart.empty()) {
        findings.push_back({NullPoseFault::PointAgainstSegment, Severity::Warning, first,
                            "Points and segments disagree about " + counted(apart.size(), "joint") + ": " +
                                listed(apart) + ".",
                            "Meshes scaled by points do not fit the segments they are moved by."});
    }
}

void findAboutShape(const NullPose& pose, Findings& findings) {
    const BodyPlaces places = bodyPlaces(pose);
    std::vector<std::string> unusable;
    for (std::size_t place = 0; place < pose.segments.size(); ++place) {
        if (!pose.segments[place].position.allFinite()) {
            unusable.push_back(std::to_string(place + 1) + " " + pose.segments[place].title());
        }
    }
    if (!unusable.empty()) {
        findings.push_back({NullPoseFault::NotFinite, Severity::Error, -1,
                            "Positions that are no numbers: " + listed(unusable) + ".",
                            "The reference body's origins are used for these segments."});
    }
    const NullPoseMeasures measures = measure(pose);
    if (findUp(pose, places, findings) || findSize(pose, measures, findings)) {
        return;
    }
    findMirror(pose, places, findings);
    findFloor(pose, places, findings);
    findAsymmetry(measures, findings);
}

void findAboutChange(const NullPoseRecord& record, Findings& findings) {
    if (record.before == nullptr) {
        return;
    }
    const NullPoseMeasures now = measure(*record.pose);
    const NullPoseMeasures then = measure(*record.before);
    std::vector<std::string> changed;
    int first = -1;
    const auto compare = [&](const SegmentLength& length, std::optional<double> a, std::optional<double> b,
                             const char* side, int segment) {
        if (a && b && std::abs(*a - *b) >= kNoise) {
            first = first < 0 ? segment : first;
            changed.push_back(side + std::string(length.name) + " " + millimetresText(*a - *b));
        }
    };
    for (std::size_t i = 0; i < now.lengths.size(); ++i) {
        const SegmentLength& length = now.lengths[i];
        const bool hasSides = length.left >= 0;
        compare(length, length.rightMetres, then.lengths[i].rightMetres, hasSides ? "right " : "",
                length.right);
        compare(length, length.leftMetres, then.lengths[i].leftMetres, "left ", length.left);
    }
    if (!changed.empty()) {
        findings.push_back(
            {NullPoseFault::LengthChanged, Severity::Warning, first,
             counted(changed.size(), "length") + " changed in mid-stream: " + listed(changed) + ".",
             "The sender was recalibrated or loaded another body. Poses before and after belong to "
             "bodies of different size: do not compare or join them without rescaling."});
    }
}

} // namespace

void findInShape(const NullPoseRecord& record, Findings& findings) {
    findAboutShape(*record.pose, findings);
    findAboutChange(record, findings);
    findPointIds(*record.pose, findings);
    findPointNames(*record.pose, findings);
    findJoints(*record.pose, findings);
}

} // namespace posewire::model
