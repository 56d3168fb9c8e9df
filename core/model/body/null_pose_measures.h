// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/null_pose.h"
#include "core/model/body/reference_body.h"
#include "core/model/body/segments.h"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace posewire::model {

/// Left and right of a body that MVN measured differ by less than 0.1 mm in every public recording: what
/// differs by more than this was entered, or is wrong. Metres.
inline constexpr double kAsymmetryThreshold = 0.005;

/// Place of each body segment in a scale message, −1 for none. The message carries no IDs: names decide where
/// all 23 are there once, else the order.
using BodyPlaces = std::array<int, kBodySegmentCount>;
[[nodiscard]] BodyPlaces bodyPlaces(const NullPose& pose);

/// Body segment at a place of the message, −1 if it is none of the body.
[[nodiscard]] int bodySegmentAt(const BodyPlaces& places, int place);

/// Origin of a body segment; empty if it was not sent or is not finite.
[[nodiscard]] std::optional<Eigen::Vector3d> originOf(const NullPose& pose, const BodyPlaces& places,
                                                      int bodySegment);

/// A point by its name, in the frame of the segments; empty if it was not sent.
[[nodiscard]] std::optional<Eigen::Vector3d> pointOf(const NullPose& pose, const BodyPlaces& places,
                                                     std::string_view name);

/// The body that a scale message describes, with its points; what it lacks is the reference body's, and all
/// of it where it has fewer segments than a body.
[[nodiscard]] BodyOrigins bodyOf(const NullPose& pose);

/// A length of the body on both sides, or of the trunk.
struct SegmentLength {
    std::string_view name;
    int right = -1; ///< body segment; for the trunk the only one
    int left = -1;  ///< −1 for the trunk
    std::optional<double> rightMetres{};
    std::optional<double> leftMetres{};

    /// Left minus right.
    [[nodiscard]] std::optional<double> difference() const;
    [[nodiscard]] bool isAsymmetric() const;
};

/// Metres.
struct NullPoseMeasures {
    std::optional<double> height{};  ///< sole to top of the head
    std::optional<double> armSpan{}; ///< fingertip to fingertip
    bool isEstimated = false;        ///< no points were sent: head, hands and soles are the reference body's
    double floor = 0;                ///< z of the soles: of what is lowest
    std::vector<SegmentLength> lengths;
};
[[nodiscard]] NullPoseMeasures measure(const NullPose& pose);

/// How far each entry of `pose` is from the same segment of another body, by place; empty if there is no
/// such segment. Metres.
using Distances = std::vector<std::optional<Eigen::Vector3d>>;

/// Against another message: as sent, without any alignment.
[[nodiscard]] Distances distancesTo(const NullPose& pose, const NullPose& before);

/// Against the reference body scaled to `height`, its pelvis over this one's, and both standing on the balls
/// of their feet.
[[nodiscard]] Distances distancesToReference(const NullPose& pose, double height);

} // namespace posewire::model
