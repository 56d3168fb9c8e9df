// SPDX-License-Identifier: MIT
#include "render/picking.h"

#include "render/bounds.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>

namespace posewire::render {
namespace {

/// The segment that a vertex follows most, twist joints counted for theirs.
std::size_t leadingSegment(const JointIndices& joints, const glm::vec4& weights,
                           std::span<const Segment> jointSegments) {
    std::array<float, kSegmentCount> shares{};
    for (int i = 0; i < 4; ++i) {
        if (joints[i] < jointSegments.size()) {
            shares[jointSegments[joints[i]]] += weights[i];
        }
    }
    return static_cast<std::size_t>(std::ranges::max_element(shares) - shares.begin());
}

/// Along the longest side of the box; about as thick as its other two.
Capsule capsuleIn(const Bounds& box) {
    if (box.isEmpty()) {
        return {};
    }
    const glm::vec3 size = box.max - box.min;
    int axis = size.x > size.y ? 0 : 1;
    axis = size.z > size[axis] ? 2 : axis;
    const float across = 0.5F * (size[(axis + 1) % 3] + size[(axis + 2) % 3]);
    Capsule capsule{box.centre(), box.centre(), 0.5F * across, 0};
    const float half = std::max(0.5F * size[axis] - capsule.radius, 0.0F);
    capsule.from[axis] -= half;
    capsule.to[axis] += half;
    return capsule;
}

std::optional<float> intersectSphere(const Ray& ray, const glm::vec3& centre, float radius) {
    const glm::vec3 offset = ray.origin - centre;
    const float b = glm::dot(offset, ray.direction);
    const float c = glm::dot(offset, offset) - radius * radius;
    const float discriminant = b * b - c;
    if (!(discriminant >= 0.0F)) {
        return std::nullopt;
    }
    const float root = std::sqrt(discriminant);
    if (-b + root < 0.0F) {
        return std::nullopt;
    }
    return std::max(-b - root, 0.0F);
}

/// The cylinder between the two end planes, without its caps.
std::optional<float> intersectSide(const Ray& ray, const Capsule& capsule) {
    const glm::vec3 axis = capsule.to - capsule.from;
    const glm::vec3 offset = ray.origin - capsule.from;
    const float axisAxis = glm::dot(axis, axis);
    if (!(axisAxis > 0.0F)) {
        return std::nullopt; // a ball has no side
    }
    const float axisRay = glm::dot(axis, ray.direction);
    const float axisOffset = glm::dot(axis, offset);
    const float a = axisAxis - axisRay * axisRay;
    const float b = axisAxis * glm::dot(ray.direction, offset) - axisOffset * axisRay;
    const float c =
        axisAxis * (glm::dot(offset, offset) - capsule.radius * capsule.radius) - axisOffset * axisOffset;
    if (c <= 0.0F && axisOffset >= 0.0F && axisOffset <= axisAxis) {
        return 0.0F;
    }
    const float discriminant = b * b - a * c;
    if (!(a > 1e-8F * axisAxis) || !(discriminant >= 0.0F)) {
        return std::nullopt;
    }
    const float distance = (-b - std::sqrt(discriminant)) / a;
    const float along = axisOffset + distance * axisRay;
    if (distance < 0.0F || along < 0.0F || along > axisAxis) {
        return std::nullopt;
    }
    return distance;
}

} // namespace

SegmentCapsules segmentCapsules(const SkinnedMesh& mesh, std::span<const Segment> jointSegments,
                                std::span<const int> segmentJoints) {
    std::array<Bounds, kSegmentCount> boxes;
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        boxes[leadingSegment(mesh.joints[i], mesh.weights[i], jointSegments)].add(mesh.positions[i]);
    }
    SegmentCapsules capsules;
    for (std::size_t segment = 0; segment < kSegmentCount; ++segment) {
        if (segmentJoints[segment] >= 0) {
            capsules[segment] = capsuleIn(boxes[segment]);
            capsules[segment].joint = static_cast<std::size_t>(segmentJoints[segment]);
        }
    }
    return capsules;
}

SegmentCapsules segmentCapsules(const SkinnedMesh& mesh) {
    std::array<Segment, kJointCount> jointSegments{};
    std::array<int, kSegmentCount> segmentJoints{};
    for (std::size_t joint = 0; joint < kJointCount; ++joint) {
        jointSegments[joint] = jointSegment(joint);
    }
    std::iota(segmentJoints.begin(), segmentJoints.end(), 0);
    return segmentCapsules(mesh, jointSegments, segmentJoints);
}

SegmentCapsules stretched(const SegmentCapsules& capsules, std::span<const Stretch> stretches) {
    SegmentCapsules all = capsules;
    for (Capsule& capsule : all) {
        if (capsule.joint >= stretches.size()) {
            continue;
        }
        const Stretch& stretch = stretches[capsule.joint];
        const glm::vec3 along = glm::abs(capsule.to - capsule.from);
        int axis = along.x > along.y ? 0 : 1;
        axis = along.z > along[axis] ? 2 : axis;
        capsule.radius *= 0.5F * (stretch.scale[(axis + 1) % 3] + stretch.scale[(axis + 2) % 3]);
        capsule.from = stretch(capsule.from);
        capsule.to = stretch(capsule.to);
    }
    return all;
}

Capsule posed(const Capsule& capsule, const DualQuaternion& motion) {
    return {transformPoint(motion, capsule.from), transformPoint(motion, capsule.to), capsule.radius,
            capsule.joint};
}

std::optional<float> intersect(const Ray& ray, const Capsule& capsule) {
    if (!(capsule.radius > 0.0F)) {
        return std::nullopt;
    }
    std::optional<float> nearest = intersectSide(ray, capsule);
    for (const glm::vec3& end : {capsule.from, capsule.to}) {
        const std::optional<float> hit = intersectSphere(ray, end, capsule.radius);
        if (hit && (!nearest || *hit < *nearest)) {
            nearest = hit;
        }
    }
    return nearest;
}

std::optional<Pick> pickSegment(const Ray& ray, std::span<const PickTarget> targets) {
    std::optional<Pick> nearest;
    for (const PickTarget& target : targets) {
        if (target.capsules == nullptr) {
            continue;
        }
        for (std::size_t segment = 0; segment < kSegmentCount; ++segment) {
            const Capsule& own = (*target.capsules)[segment];
            if (own.joint >= target.palette.size()) {
                continue;
            }
            const Capsule capsule = posed(own, target.palette[own.joint]);
            const std::optional<float> hit = intersect(ray, capsule);
            if (hit && (!nearest || *hit < nearest->distance)) {
                nearest = Pick{target.id, static_cast<int>(segment), *hit};
            }
        }
    }
    return nearest;
}

} // namespace posewire::render
