// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/outlets/pose_outlet.h"

namespace posewire::outlets {

/// Poses of all characters as ROS 2 has them, by DDS: /tf (tf2_msgs/TFMessage) and /joint_states
/// (sensor_msgs/JointState); packaging/formats.md lists frames and joints. `place` is the domain, 0 to 232.
[[nodiscard]] MakeWriter rosIn(const OutletChoice& choice);

} // namespace posewire::outlets
