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
using words::Fact;
using words::Number;
using K = words::Kind;

constexpr double kLeastStature = 0.4;    ///< an infant
constexpr double kGreatestStature = 2.6; ///< the tallest person known had 2.72 m
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

/// A name and what is said about it.
Fact beside(std::string name, std::string value, K kind = K::Beside) {
    return {kind, {{"name", std::move(name)}, {"value", std::move(value)}}};
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

/// True if the size is no person's: other findings about places would only repeat it.
bool findSize(const NullPose& pose, const NullPoseMeasures& measures, Findings& findings) {
    const double size =
        measures.height && *measures.height > 0 ? *measures.height : extentOf(pose).maxCoeff();
    if (isStature(size) || size <= 0) {
        return false;
    }
    for (const auto& [unit, factor] :
         {std::pair{K::Centimetres, 0.01}, std::pair{K::Millimetres, 0.001}, std::pair{K::Inches, 0.0254}}) {
        if (size > kGreatestStature && isStature(size * factor)) {
            findings.push_back({{K::OtherUnit,
                                 {{"height", Number{size, size < 10 ? 2 : 0}},
                                  {"looks", Fact{unit}},
                                  {"metres", Number{size * factor, 2}},
                                  {"factor", Number{factor, 4}}}}});
            return true;
        }
    }
    findings.push_back({{K::Stature, {{"height", Number{size, 2}}}}});
    return size > kGreatestStature;
}

/// True if the body does not stand along z.
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
    Fact fact{K::StandsAskew, {{"axis", std::string(up[axis] < 0 ? "−" : "") + "xyz"[axis]}}};
    if (axis == 1) {
        words::set(fact, "written", std::string("Y-up"));
    }
    findings.push_back({std::move(fact), kHead});
    return true;
}

void findMirror(const NullPose& pose, const BodyPlaces& places, Findings& findings) {
    std::uint64_t exchanged = 0;
    std::uint64_t judged = 0;
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
    if (exchanged == judged && judged != 0) {
        findings.push_back({K::Mirrored, first});
    } else if (exchanged != 0) {
        findings.push_back(
            {{K::PartlyMirrored, {{"n", exchanged}, {"all", judged}, {"name", nameOf(first)}}}, first});
    }
}

void findFloor(const NullPose& pose, const BodyPlaces& places, Findings& findings) {
    const auto pelvis = originOf(pose, places, kPelvis);
    std::vector<Fact> below;
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
            below.push_back(beside(nameOf(index), millimetresText(origin->z())));
        }
        if (origin->z() < depth) {
            depth = origin->z();
            lowest = index;
        }
    }
    if (!below.empty() && pelvis && pelvis->norm() < kFloorTolerance) {
        findings.push_back({{K::PelvisAtOrigin, {{"height", Number{-depth, 3}}}}, lowest});
    } else if (!below.empty()) {
        addListed(K::BelowFloor, std::move(below), lowest, findings);
    } else if (std::isfinite(stand) && stand > kAboveFloor) {
        findings.push_back({{K::AboveFloor, {{"height", Number{stand, 3}}}}});
    }
}

void findAsymmetry(const NullPoseMeasures& measures, Findings& findings) {
    std::vector<Fact> uneven;
    int first = -1;
    for (const SegmentLength& length : measures.lengths) {
        if (length.isAsymmetric()) {
            first = first < 0 ? length.left : first;
            uneven.push_back(
                beside(std::string(length.name), millimetresText(*length.difference()), K::LeftBy));
        }
    }
    addListed(K::Asymmetric, std::move(uneven), first, findings);
}

Fact pointFact(const NullPose::Point& point, K kind = K::Beside) {
    return beside(std::to_string(point.segment) + "." + std::to_string(point.id), point.name.shown(), kind);
}

void findPointIds(const NullPose& pose, Findings& findings) {
    const auto count = static_cast<int>(pose.segments.size());
    std::set<std::pair<int, int>> ids;
    std::vector<Fact> lost;
    std::vector<Fact> twice;
    for (const NullPose::Point& point : pose.points) {
        if (point.segment < 1 || point.segment > count) {
            lost.push_back(pointFact(point));
        }
        if (!ids.insert({point.segment, point.id}).second) {
            twice.push_back(pointFact(point));
        }
    }
    // As long as segments are on their way, it is not known where points belong.
    if (count > 0 && !lost.empty()) {
        addListed(K::PointsWithoutSegment, std::move(lost), -1, findings);
        words::set(findings.back().fact, "all", static_cast<std::uint64_t>(count));
    }
    addListed(K::PointIdsTwice, std::move(twice), -1, findings);
}

void findPointNames(const NullPose& pose, Findings& findings) {
    std::vector<Fact> other;
    for (const NullPose::Point& point : pose.points) {
        const AnatomicalPoint* known = findPoint(point.segment - 1, point.id);
        if (known != nullptr && !(point.name == known->name)) {
            other.push_back(pointFact(point, K::KnownAs));
            words::set(other.back(), "known", std::string(known->name));
        }
    }
    addListed(K::PointNames, std::move(other), -1, findings);
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
    std::vector<Fact> apart;
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
            apart.push_back({K::ApartBy, {{"name", shownText(joint)}, {"value", Number{distance * 1000.0}}}});
        }
    }
    addListed(K::JointsApart, std::move(apart), first, findings);
}

void findAboutShape(const NullPose& pose, Findings& findings) {
    const BodyPlaces places = bodyPlaces(pose);
    std::vector<Fact> unusable;
    for (std::size_t place = 0; place < pose.segments.size(); ++place) {
        if (!pose.segments[place].position.allFinite()) {
            unusable.push_back(beside(std::to_string(place + 1), pose.segments[place].title()));
        }
    }
    addListed(K::NotNumbers, std::move(unusable), -1, findings);
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
    std::vector<Fact> changed;
    int first = -1;
    const auto compare = [&](const SegmentLength& length, std::optional<double> a, std::optional<double> b,
                             K side, int segment) {
        if (a && b && std::abs(*a - *b) >= kNoise) {
            first = first < 0 ? segment : first;
            changed.push_back(beside(std::string(length.name), millimetresText(*a - *b), side));
        }
    };
    for (std::size_t i = 0; i < now.lengths.size(); ++i) {
        const SegmentLength& length = now.lengths[i];
        compare(length, length.rightMetres, then.lengths[i].rightMetres,
                length.left >= 0 ? K::RightSide : K::Beside, length.right);
        compare(length, length.leftMetres, then.lengths[i].leftMetres, K::LeftSide, length.left);
    }
    addListed(K::LengthsChanged, std::move(changed), first, findings);
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
