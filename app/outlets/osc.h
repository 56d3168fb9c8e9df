// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/outlets/pose_outlet.h"

namespace posewire::outlets {

/// Poses of all characters as bundles of Open Sound Control 1.0, by UDP; packaging/formats.md lists the
/// addresses. Metres, Z up.
[[nodiscard]] MakeWriter oscTo(const OutletChoice& choice);

/// Poses of one character as the Virtual Motion Capture protocol has them (protocol.vmc.info, performer to
/// marionette), by UDP: VRM's bones relative to their parents; Unity's space: metres, Y up, left-handed.
[[nodiscard]] MakeWriter vmcTo(const OutletChoice& choice);

} // namespace posewire::outlets
