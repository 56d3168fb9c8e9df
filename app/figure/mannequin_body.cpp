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
    std::ranges::transform(fitted.joints, std::back_inserter(body.segments), [](render::JointIndices joints) {
        std::ranges::transform(joints, joints.begin(), render::jointSegment);
        return joints;
    });
    std::ranges::transform(fitted.weights, std::back_inserter(body.weights), [](const glm::vec4& weights) {
        return std::array{weights.x, weights.y, weights.z, weights.w};
    });
    body.indices = fitted.indices;
    std::ranges::transform(fit.origins, body.origins.begin(),
                           [](const glm::vec3& at) { return Eigen::Vector3d(at.x, at.y, at.z); });
    return body;
}

} // namespace posewire::figure
