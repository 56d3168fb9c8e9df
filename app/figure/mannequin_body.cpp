// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/figure/mannequin_body.h"

#include "render/mesh/mannequin.h"
#include "render/mesh/null_pose_fit.h"

#include <algorithm>
#include <iterator>

namespace posewire::figure {
namespace {

std::array<float, 3> plain(const glm::vec3& vector) {
    return {vector.x, vector.y, vector.z};
}

/// What moves a vertex, each segment once: twist and half joints and fingers count for their segments. Places
/// that are not needed name segment 0 and weigh nothing.
void addInfluences(render::JointIndices joints, const glm::vec4& weights, exporting::BodyMesh& body) {
    std::array<std::uint8_t, 4> segments{};
    std::array<float, 4> shares{};
    std::size_t count = 0;
    float sum = 0;
    for (std::size_t k = 0; k < joints.size(); ++k) {
        const float weight = weights[static_cast<int>(k)];
        if (weight <= 0) {
            continue;
        }
        const auto segment = static_cast<std::uint8_t>(render::jointSegment(joints[k]));
        const auto known = static_cast<std::size_t>(
            std::find(segments.begin(), segments.begin() + static_cast<std::ptrdiff_t>(count), segment) -
            segments.begin());
        segments[known] = segment;
        shares[known] += weight;
        count = std::max(count, known + 1);
        sum += weight;
    }
    std::ranges::transform(shares, shares.begin(), [sum](float share) { return share / sum; });
    body.segments.push_back(segments);
    body.weights.push_back(shares);
}

} // namespace

exporting::BodyMesh mannequinBody(const model::BodyOrigins& performer) {
    static const render::SkinnedMesh mannequin = render::loadMannequin(render::Detail::Medium);
    render::NullPose pose{};
    std::ranges::transform(performer.places, pose.begin(), [](const Eigen::Vector3d& place) {
        const Eigen::Vector3f at = place.cast<float>();
        return glm::vec3(at.x(), at.y(), at.z());
    });
    const render::BodyFit fit = render::fitBody(pose);
    const render::SkinnedMesh fitted = render::fitted(mannequin, fit);
    exporting::BodyMesh body;
    std::ranges::transform(fitted.positions, std::back_inserter(body.positions), plain);
    std::ranges::transform(fitted.normals, std::back_inserter(body.normals), plain);
    for (std::size_t i = 0; i < fitted.joints.size(); ++i) {
        addInfluences(fitted.joints[i], fitted.weights[i], body);
    }
    body.indices = fitted.indices;
    std::ranges::transform(fit.origins, body.origins.begin(),
                           [](const glm::vec3& at) { return Eigen::Vector3d(at.x, at.y, at.z); });
    return body;
}

} // namespace posewire::figure
