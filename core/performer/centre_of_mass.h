// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/body_pose.h"

#include <span>

namespace posewire::performer {

/// Share of a segment in the mass of the body; the 23 add up to 1. After Dempster and Winter, the trunk split
/// over its segments.
double massShare(int segment);

/// Centre of mass of the body, from the 23 segments in the world. Each segment's own centre lies on the way
/// from its origin to the far joint, at the shares tabulated by Winter.
Eigen::Vector3d centreOfMass(const model::ReferenceBody& body, std::span<const model::SegmentPose> segments);

} // namespace posewire::performer
