// SPDX-License-Identifier: MIT
#include "core/model/session/detection.h"

#include "core/model/body/segments.h"
#include "core/model/body/spaces.h"
#include "core/wire/messages.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <cmath>

namespace posewire::model {
namespace {

template <class Position>
double apart(const Position& a, const Position& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// Segments without finite positions are left out.
template <class Item>
double reachOf(const std::vector<Item>& segments) {
    double reach = 0;
    for (std::size_t i = 1; i < std::min<std::size_t>(segments.size(), kBodySegmentCount); ++i) {
        const double next = apart(segments[i].position, segments[0].position);
        reach = std::isfinite(next) ? std::max(reach, next) : reach;
    }
    return reach;
}

/// A segment of the body, by its place if all are there, else by its ID; null if it was not sent.
template <class Item>
const Item* segmentOf(const std::vector<Item>& items, int segment) {
    if (items.size() >= kBodySegments) {
        return &items[static_cast<std::size_t>(segment)];
    }
    const auto found = std::ranges::find(items, static_cast<std::uint32_t>(segment) + 1, &Item::id);
    return found != items.end() ? &*found : nullptr;
}

/// The direction from one segment to another in the frame of the first; zero where it is not known.
Eigen::Vector3d boneOf(const wire::PoseQuaternion& pose, int from, int to, int frame) {
    const auto* begin = segmentOf(pose.segments, from);
    const auto* end = segmentOf(pose.segments, to);
    const auto* turned = segmentOf(pose.segments, frame);
    if (begin == nullptr || end == nullptr || turned == nullptr) {
        return Eigen::Vector3d::Zero();
    }
    const Eigen::Quaterniond turn = toQuaternion(turned->orientation);
    const Eigen::Vector3d bone =
        turn.conjugate() * (toVector(end->position) - toVector(begin->position)).normalized();
    return std::abs(turn.norm() - 1) < 0.1 && bone.allFinite() ? bone : Eigen::Vector3d::Zero();
}

/// In their own frames thighs hang down and the left hip is on the left, in any posture. A mirrored frame is
/// neither.
std::optional<UpAxis> upByThighs(const wire::PoseQuaternion& pose) {
    using namespace segment;
    constexpr double kAlong = 0.8;
    const Eigen::Vector3d right = boneOf(pose, kRightUpperLeg, kRightLowerLeg, kRightUpperLeg);
    const Eigen::Vector3d left = boneOf(pose, kLeftUpperLeg, kLeftLowerLeg, kLeftUpperLeg);
    const Eigen::Vector3d hips = boneOf(pose, kRightUpperLeg, kLeftUpperLeg, kPelvis);
    const Eigen::Vector3d down = right.cwiseMax(left);
    if (down.z() < -kAlong && hips.y() > kAlong) {
        return UpAxis::Z;
    }
    return down.y() < -kAlong && hips.x() > kAlong ? std::optional(UpAxis::Y) : std::nullopt;
}

/// Knees bend about the axis that points left.
std::optional<UpAxis> upByKnees(const wire::AngularKinematics& angular) {
    using namespace segment;
    constexpr double kBent = 0.1; // sine of half the angle
    constexpr double kAlong = 0.9;
    Eigen::Vector3d most = Eigen::Vector3d::Zero();
    for (const int thigh : {kRightUpperLeg, kLeftUpperLeg}) {
        const auto* upper = segmentOf(angular.segments, thigh);
        const auto* lower = segmentOf(angular.segments, thigh + 1);
        if (upper != nullptr && lower != nullptr) {
            const Eigen::Quaterniond bend =
                toQuaternion(upper->orientation).conjugate() * toQuaternion(lower->orientation);
            const Eigen::Vector3d axis = std::copysign(1.0, bend.w()) * bend.vec();
            most = std::abs(bend.norm() - 1) < 0.1 && axis.norm() > most.norm() ? axis : most;
        }
    }
    if (most.norm() < kBent || std::max(most.y(), most.x()) < kAlong * most.norm()) {
        return std::nullopt;
    }
    return most.y() > most.x() ? UpAxis::Z : UpAxis::Y;
}

/// Positions alone: somebody who stands on the floor, the head above the feet.
std::optional<UpAxis> upByStature(const wire::LinearKinematics& linear) {
    const auto* head = segmentOf(linear.segments, segment::kHead);
    const auto* right = segmentOf(linear.segments, segment::kRightFoot);
    const auto* left = segmentOf(linear.segments, segment::kLeftFoot);
    if (head == nullptr || right == nullptr || left == nullptr) {
        return std::nullopt;
    }
    const Eigen::Vector3d feet = 0.5 * (toVector(right->position) + toVector(left->position));
    const Eigen::Vector3d stature = toVector(head->position) - feet;
    const double metres = metresPer(detectLengthUnit(stature.norm()));
    const auto isUp = [&](int axis) {
        return stature[axis] * metres > 0.9 && stature[axis] > 0.9 * stature.norm() &&
               std::abs(feet[axis] * metres - 0.1) < 0.2;
    };
    return isUp(2) ? std::optional(UpAxis::Z) : isUp(1) ? std::optional(UpAxis::Y) : std::nullopt;
}

bool isSinceJ(const wire::TypeInfo* info) {
    return info != nullptr && info->firstRevision() >= 'J';
}

bool isOfEAlone(const wire::TypeInfo* info) {
    return info != nullptr && info->firstRevision() == 'E' && info->isInOneRevision();
}

} // namespace

words::Kind revisionName(Revision revision) {
    using enum words::Kind;
    constexpr std::array kNames{RevisionUnknown, RevisionE, RevisionJOrK, RevisionN};
    return kNames[static_cast<std::size_t>(revision)];
}

words::Kind unitName(LengthUnit unit) {
    return unit == LengthUnit::Metre        ? words::Kind::Metres
           : unit == LengthUnit::Centimetre ? words::Kind::Centimetres
                                            : words::Kind::Millimetres;
}

words::Kind upName(UpAxis up) {
    return up == UpAxis::Z ? words::Kind::ZUp : words::Kind::YUp;
}

std::optional<UpAxis> upNamed(std::string_view name) {
    return name == "z" ? std::optional(UpAxis::Z) : name == "y" ? std::optional(UpAxis::Y) : std::nullopt;
}

/// Evidence only ever grows: header counts outweigh message types, and those that only E has outweigh common
/// ones.
void Detector::addHeader(const wire::Header& header) {
    const std::uint8_t type = header.type();
    const bool isCounted = header.bodySegments != 0 || header.payloadSize != 0;
    const HeaderForm form = isCounted ? kCounted : kReserved;
    m_allForms |= form;
    std::uint8_t& forms = m_headerForms[type % m_headerForms.size()];
    forms |= form;
    if (forms == kBoth && !m_typeOfBothForms) {
        m_typeOfBothForms = type;
    }
    const wire::TypeInfo* info = wire::findType(type);
    if (!m_typeSinceJ && isSinceJ(info)) {
        m_typeSinceJ = type;
    }
    if (isCounted && m_revision < Revision::N) {
        conclude(Revision::N, words::Kind::CountsInHeader);
    } else if (!isCounted && isSinceJ(info) && m_revision < Revision::JOrK) {
        conclude(Revision::JOrK, {words::Kind::ReservedHeader, {{"type", wire::typeDigits(type)}}});
    } else if (!isCounted && isOfEAlone(info) && m_revision < Revision::E) {
        conclude(Revision::E, {words::Kind::DeprecatedType, {{"type", wire::typeDigits(type)}}});
    }
}

void Detector::conclude(Revision revision, words::Fact evidence) {
    m_revision = revision;
    m_revisionEvidence = std::move(evidence);
}

template <class Value>
void Finder<Value>::add(Value value, const words::Fact& evidence, unsigned patience,
                        words::Kind (*name)(Value)) {
    m_otherRun = value == m_value ? 0 : m_otherRun + 1;
    if (value == m_value ? !m_evidence.isNothing() : m_otherRun < patience) {
        return;
    }
    if (!m_evidence.isNothing()) {
        m_before = {words::Kind::UnitBy, {{"looks", words::Fact(name(m_value))}, {"evidence", m_evidence}}};
    }
    m_evidence = evidence;
    m_value = value;
    m_otherRun = 0;
}

void UnitFinder::add(double height, double reach) {
    const bool hasHeight = height > 0.05;
    const bool hasReach = reach >= 0.1;
    const LengthUnit unit = detectLengthUnit(hasHeight ? height : reach);
    const bool isOfBody = hasReach || unit != LengthUnit::Millimetre; // an object may be high up
    const bool isSane = reach < 5'000; // of a body in millimetres, else it is no number of a pose
    if ((hasHeight || hasReach) && isSane && isOfBody &&
        !(hasHeight && hasReach && detectLengthUnit(reach) != unit)) {
        Finder::add(unit,
                    {hasHeight ? words::Kind::PelvisAt : words::Kind::ReachOf,
                     {{"value", words::Number{hasHeight ? height : reach, 2}}}},
                    evidence().isNothing() ? 1 : kPatience, unitName);
    }
}

void Detector::addBody(const wire::Body& body) {
    const auto add = [this](const auto& message) {
        if constexpr (requires { message.segments.front().position; }) {
            static const wire::TypeInfo& info = *wire::findType(message.kType);
            const bool isYUp = info.frame == wire::Frame::YUp;
            const bool isZUp = info.frame == wire::Frame::ZUp && info.isSampled;
            if ((isYUp || isZUp) && !message.segments.empty()) {
                const auto& pelvis = message.segments.front().position;
                (isYUp ? m_yUp : m_zUp)
                    .add(pelvis[isYUp || up() == UpAxis::Y ? 1 : 2], reachOf(message.segments));
            }
        }
    };
    addUp(body);
    std::visit(add, body);
}

void Detector::addUp(const wire::Body& body) {
    constexpr unsigned kFirst = 10;   // segments show it in any posture
    constexpr unsigned kUpright = 60; // about a second of upright positions
    const bool isKnown = !m_up.evidence().isNothing();
    std::optional<UpAxis> up;
    unsigned patience = isKnown ? UnitFinder::kPatience : kFirst;
    if (const auto* pose = std::get_if<wire::PoseQuaternion>(&body)) {
        up = upByThighs(*pose);
    } else if (const auto* angular = std::get_if<wire::AngularKinematics>(&body)) {
        up = upByKnees(*angular);
    } else if (const auto* linear = std::get_if<wire::LinearKinematics>(&body); linear && !isKnown) {
        up = upByStature(*linear);
        patience = kUpright;
    }
    if (up) {
        m_up.add(*up, {words::Kind::UprightAlong, {{"axis", *up == UpAxis::Y ? "y" : "z"}}}, patience,
                 upName);
    }
}

std::optional<words::Fact> Detector::againstRevision(Revision declared) const {
    using K = words::Kind;
    const words::NamedValue said{"declared", words::Fact(revisionName(declared))};
    const bool hasCounts = (m_allForms & kCounted) != 0;
    if (declared != Revision::N && hasCounts) {
        return words::Fact{K::SendsCounts, {said}};
    }
    if (declared == Revision::N && m_allForms == kReserved) {
        return words::Fact{K::SendsNoCounts, {said}};
    }
    if (declared == Revision::E && m_typeSinceJ) {
        return words::Fact{K::SendsTypeSinceJ, {said, {"type", wire::typeDigits(*m_typeSinceJ)}}};
    }
    return std::nullopt;
}

std::vector<words::Fact> Detector::contradictions(const SenderOverride& declared) const {
    using K = words::Kind;
    std::vector<words::Fact> found;
    if (declared.revision) {
        if (auto one = againstRevision(*declared.revision)) {
            found.push_back(std::move(*one));
        }
    }
    if (m_typeOfBothForms) {
        found.push_back({K::CountsComeAndGo, {{"type", wire::typeDigits(*m_typeOfBothForms)}}});
    }
    const words::NamedValue looks{"looks", words::Fact(unitName(m_zUp.unit()))};
    const words::NamedValue evidence{"evidence", m_zUp.evidence()};
    if (declared.positionUnit && !m_zUp.evidence().isNothing() && *declared.positionUnit != m_zUp.unit()) {
        found.push_back(
            {K::ReadInOtherUnit, {looks, evidence, {"read", words::Fact(unitName(*declared.positionUnit))}}});
    }
    if (!m_zUp.before().isNothing() && m_zUp.unit() != LengthUnit::Millimetre) { // that is a content fault
        found.push_back({K::UnitChanged, {looks, evidence, {"before", m_zUp.before()}}});
    }
    const words::NamedValue looksUp{"looks", words::Fact(upName(up()))};
    const words::NamedValue upEvidence{"evidence", m_up.evidence()};
    if (declared.up && !m_up.evidence().isNothing() && *declared.up != up()) {
        found.push_back(
            {K::ReadInOtherUnit, {looksUp, upEvidence, {"read", words::Fact(upName(*declared.up))}}});
    }
    if (!m_up.before().isNothing()) {
        found.push_back({K::UnitChanged, {looksUp, upEvidence, {"before", m_up.before()}}});
    }
    return found;
}

} // namespace posewire::model
