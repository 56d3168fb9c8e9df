// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/joint_angles.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

namespace posewire::model {

/// Radians.
struct AngleRange {
    double least = std::numeric_limits<double>::infinity();
    double most = -std::numeric_limits<double>::infinity();

    [[nodiscard]] bool isEmpty() const { return least > most; }
    void add(const AngleRange& other);
    /// Radians by which an angle is outside; 0 within.
    [[nodiscard]] double excess(double angle) const;
};

/// The source of the average ranges of motion below.
inline constexpr std::string_view kRangeSource =
    "American Academy of Orthopaedic Surgeons: Joint Motion, Method of Measuring and Recording (1965)";

/// How far a healthy joint goes about an axis of type 20 (0 abduction, 1 rotation, 2 flexion), in the zero
/// and the signs of type 20. Nothing if the source has no such range: single joints of the spine, the
/// shoulder girdle, and motion that a joint does not make by itself.
std::optional<AngleRange> referenceRange(std::size_t joint, std::size_t axis);

/// The one of the equal forms that is least beyond the reference ranges, each angle in the turn about the
/// middle of its range. An arm held straight up is 170° of abduction rather than 10°, turned by 180° twice.
Eigen::Vector3d anatomicalAngles(std::size_t joint, const Eigen::Vector3d& angles);

/// The angles that the 22 joints took, as anatomicalAngles() has them.
class JointExtents {
public:
    /// Leaves out what is not known, and flexion and rotation near the gimbal lock, where they mean little.
    void add(const BodyAngles& angles);
    void add(const JointExtents& other);

    [[nodiscard]] const AngleRange& range(std::size_t joint, std::size_t axis) const {
        return m_ranges[joint][axis];
    }
    [[nodiscard]] bool isBeyond(std::size_t joint, std::size_t axis) const;
    [[nodiscard]] std::uint64_t samples() const { return m_samples; }

private:
    std::array<std::array<AngleRange, 3>, kBodyJointCount> m_ranges{};
    std::uint64_t m_samples = 0;
};

} // namespace posewire::model
