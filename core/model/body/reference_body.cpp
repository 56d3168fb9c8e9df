// SPDX-License-Identifier: MIT
#include "core/model/body/reference_body.h"

#include <algorithm>

namespace posewire::model {
namespace {

using Eigen::Vector3d;
using namespace segment;

using Origins = std::array<Vector3d, kBodySegmentCount>;

bool isArm(int index) {
    return (index >= kRightUpperArm && index <= kRightHand) || (index >= kLeftUpperArm && index <= kLeftHand);
}

bool isLeg(int index) {
    return index == kRightUpperLeg || index == kRightLowerLeg || index == kLeftUpperLeg ||
           index == kLeftLowerLeg;
}

/// Factors along x, y and z for what lies inside a segment: its points and the way to its children.
Vector3d stretch(int index, const BodyProportions& proportions) {
    if (isArm(index)) {
        return {1.0, proportions.arms, 1.0};
    }
    if (isLeg(index)) {
        return {1.0, 1.0, proportions.legs};
    }
    const bool isShoulder = index == kT8 || index == kRightShoulder || index == kLeftShoulder;
    return {1.0, index == kPelvis ? proportions.hips : isShoulder ? proportions.shoulders : 1.0, 1.0};
}

} // namespace

const Origins& referenceOrigins() {
    static const Origins origins = {{
        {0.0, 0.0, 0.9275},     {0.0, 0.0, 1.0275},     {0.0, 0.0, 1.1383},       {0.0, 0.0, 1.2394},
        {0.0, 0.0, 1.3404},     {0.0, 0.0, 1.4817},     {0.0, 0.0, 1.5758},       {0.0, -0.0280, 1.4196},
        {0.0, -0.1650, 1.4196}, {0.0, -0.4500, 1.4196}, {0.0, -0.6850, 1.4196},   {0.0, 0.0280, 1.4196},
        {0.0, 0.1650, 1.4196},  {0.0, 0.4500, 1.4196},  {0.0, 0.6850, 1.4196},    {0.0, -0.0840, 0.9275},
        {0.0, -0.0840, 0.4990}, {0.0, -0.0840, 0.0800}, {0.148, -0.0840, 0.0150}, {0.0, 0.0840, 0.9275},
        {0.0, 0.0840, 0.4990},  {0.0, 0.0840, 0.0800},  {0.148, 0.0840, 0.0150},
    }};
    return origins;
}

Vector3d ReferenceBody::nullPoseOrigin(int segment) const {
    return origins[static_cast<std::size_t>(segment)] - Vector3d(0.0, 0.0, soleDrop);
}

Vector3d ReferenceBody::offset(int segment) const {
    const auto index = static_cast<std::size_t>(segment);
    const int parent = bodySegments()[index].parent;
    return parent < 0 ? origins[index] : Vector3d(origins[index] - origins[static_cast<std::size_t>(parent)]);
}

double ReferenceBody::legLength() const {
    return offset(kRightLowerLeg).norm() + offset(kRightFoot).norm();
}

double BodyOrigins::scale() const {
    const double height = places[kPelvis].z() - floor;
    return height > 0 ? height / referenceOrigins()[kPelvis].z() : 1.0;
}

std::optional<Vector3d> BodyOrigins::pointOf(int segment, int localId) const {
    const auto sent = std::ranges::find_if(
        points, [=](const Point& one) { return one.segment == segment && one.localId == localId; });
    if (sent != points.end()) {
        return sent->position;
    }
    const AnatomicalPoint* known = findPoint(segment, localId);
    return known == nullptr ? std::nullopt
                            : std::optional<Vector3d>(scale() * Vector3d(known->reference.data()));
}

ReferenceBody makeReferenceBody(const BodyProportions& proportions) {
    const double scale = proportions.stature / kReferenceStature;
    const Origins& reference = referenceOrigins();
    ReferenceBody body;
    body.stature = proportions.stature;
    body.soleDrop = kReferenceSoleDrop * scale;
    for (int index = 0; index < kBodySegmentCount; ++index) {
        const auto place = static_cast<std::size_t>(index);
        const int parent = bodySegments()[place].parent;
        if (parent < 0) {
            body.origins[place] = reference[place] * scale;
            continue;
        }
        const auto parentPlace = static_cast<std::size_t>(parent);
        const Vector3d way = reference[place] - reference[parentPlace];
        body.origins[place] =
            body.origins[parentPlace] + scale * way.cwiseProduct(stretch(parent, proportions));
    }
    const double lift = reference[kRightFoot].z() * scale - body.origins[kRightFoot].z();
    for (Vector3d& origin : body.origins) {
        origin.z() += lift;
    }
    const auto points = anatomicalPoints();
    for (std::size_t place = 0; place < points.size(); ++place) {
        body.points[place] = scale * Eigen::Vector3d(points[place].reference.data())
                                         .cwiseProduct(stretch(points[place].segment, proportions));
    }
    return body;
}

} // namespace posewire::model
