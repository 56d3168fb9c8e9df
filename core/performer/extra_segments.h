// SPDX-License-Identifier: MIT
#pragma once

#include "core/performer/body_pose.h"

#include <string_view>
#include <vector>

namespace posewire::performer {

/// Poses of the props and fingers that follow the body in a pose datagram.
struct ExtraSegments {
    model::SegmentLayout layout;

    /// Appends them to `poses`, which holds the body alone. `curl` from 0 (flat hand) to 1 (fist).
    void append(const model::ReferenceBody& body, double curl, std::vector<model::SegmentPose>& poses) const;

    /// Appends their origins in the null pose to `origins`, in the frame of the body's own.
    void appendNullPose(const model::ReferenceBody& body, std::vector<Eigen::Vector3d>& origins) const;
};

/// "Sword", "Crutch", "Generic" and "Golfclub", as a sender names its props.
std::string_view propName(int prop);

} // namespace posewire::performer
