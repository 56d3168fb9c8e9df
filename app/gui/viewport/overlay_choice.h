// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bitset>
#include <cstdint>

namespace posewire::gui {

/// What can be drawn over the figures, each switched on its own.
enum class Overlay : std::uint8_t {
    SegmentNames,
    JointAngles,
    Markers,
    Trackers,
    CentreOfMass,
    Contacts,
    Velocity,
    Acceleration,
    Trails,
};
inline constexpr std::size_t kOverlayCount = 9;

/// Which are on.
class Overlays {
public:
    [[nodiscard]] bool has(Overlay overlay) const { return m_on[static_cast<std::size_t>(overlay)]; }
    void toggle(Overlay overlay) { m_on.flip(static_cast<std::size_t>(overlay)); }
    [[nodiscard]] bool isAny() const { return m_on.any(); }
    friend bool operator==(const Overlays&, const Overlays&) = default;

private:
    std::bitset<kOverlayCount> m_on;
};

} // namespace posewire::gui
