// SPDX-License-Identifier: MIT
#include "core/model/body/ground_contact.h"

#include <algorithm>
#include <tuple>

namespace posewire::model {
namespace {

using Eigen::Vector3d;

/// Positive where `c` is to the left of the way from `a` to `b`.
double turn(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// One side of the hull.
template <class Points>
void addChain(const Points& points, std::vector<Vector3d>& hull) {
    const std::size_t first = hull.size();
    for (const Vector3d& point : points) {
        while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0) {
            hull.pop_back();
        }
        hull.push_back(point);
    }
    hull.pop_back(); // it begins the other side
}

} // namespace

std::vector<Vector3d> soleContacts(const CharacterPose& pose, const BodyOrigins& body) {
    std::vector<Vector3d> contacts;
    for (const SolePoint& point : kSolePoints) {
        const auto place = static_cast<std::size_t>(point.segment);
        const auto local = body.pointOf(point.segment, point.localId);
        if (pose.isObjects || !pose.isPresent(place) || !local) {
            continue;
        }
        const Vector3d at = pose.segments[place].position + pose.segments[place].orientation * *local;
        if (at.z() < kContactHeight) {
            contacts.push_back(at);
        }
    }
    return contacts;
}

std::vector<Vector3d> supportPolygon(std::vector<Vector3d> points) {
    if (points.size() < 3) {
        return points;
    }
    std::ranges::sort(points, {}, [](const Vector3d& point) { return std::tuple(point.x(), point.y()); });
    std::vector<Vector3d> hull;
    addChain(points, hull);
    std::ranges::reverse(points);
    addChain(points, hull);
    return hull;
}

} // namespace posewire::model
