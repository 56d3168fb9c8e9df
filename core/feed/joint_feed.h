// SPDX-License-Identifier: MIT
#pragma once

#include "core/feed/pose_feed.h"
#include "core/model/body/joint_ranges.h"

#include <cstdint>
#include <deque>
#include <utility>

namespace posewire::feed {

/// Follows a log and bounds the angles of one character's joints. One thread, any; memory does not grow with
/// the range.
class JointFeed {
public:
    /// Reads the first character of `source`: its messages of type 20 if `isSent`, else its poses. `window`:
    /// how much of the end counts, to about a 64th; zero counts all.
    JointFeed(PoseSource source, bool isSent, log::Duration window);

    /// As PoseFeed::update().
    void update(PoseSource newest);
    /// As PoseFeed::advance().
    bool advance(log::Stamp now);
    /// Those of the samples read that are in the window before the newest one.
    [[nodiscard]] model::JointExtents extents() const;

private:
    bool readSent();
    void add(log::Stamp stamp, const model::BodyAngles& angles);

    PoseSource m_source; ///< the newest; its end is as far as is read
    bool m_isSent;
    log::Duration m_part; ///< of the window; zero for one part
    PoseFeed m_poses;
    log::LogFollower m_follower; ///< of type 20
    wire::Datagram m_datagram;
    std::deque<std::pair<log::Stamp, model::JointExtents>> m_parts; ///< by where each begins
};

} // namespace posewire::feed
