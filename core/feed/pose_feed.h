// SPDX-License-Identifier: MIT
#pragma once

#include "core/feed/pose_source.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace posewire::feed {

/// What is read of a character.
enum class PoseContent : std::uint8_t {
    Segments, ///< the poses that the viewport shows
    Markers,  ///< the points of type 03
};

/// A point of type 03. Metres, Z-up.
struct Marker {
    std::uint32_t id = 0; ///< as sent
    Eigen::Vector3d position;
};

/// A whole sample of one character.
struct PoseSample {
    std::size_t character = 0;   ///< its place in the source
    model::CharacterPose pose;   ///< without segments if markers are read
    std::vector<Marker> markers; ///< none if poses are read
    bool beginsRun = false;      ///< the first one, or the first after a restart
};

/// Valid during the call.
using TakePose = std::function<void(const PoseSample&)>;

/// Follows a log and hands out whole samples of the source's characters, those of each in the order of their
/// counters. Poses come from every type that holds some, as choosePose and assemble decide for the viewport:
/// 01, 02, 05; 21, 22 and 03, alone or together; joined from their datagrams. One thread, any; memory does
/// not grow with the range.
class PoseFeed {
public:
    /// How long a sample waits for those before it, and for its other messages.
    static constexpr log::Duration kWait = std::chrono::seconds(4);

    /// The source outlives this. Of what is received live, `wait` is how late samples are at most.
    PoseFeed(const PoseSource& source, PoseContent content, log::Duration wait = kWait);
    ~PoseFeed();
    PoseFeed(const PoseFeed&) = delete;
    PoseFeed& operator=(const PoseFeed&) = delete;

    /// Reads on for some packets; false if there were none left for now. At the end of the source's range all
    /// samples are handed out, before that those that have waited at `now`.
    bool advance(const TakePose& take, log::Stamp now = {});
    /// How much of the range was read, from 0 to 1.
    [[nodiscard]] double share() const;
    /// Packets of the range that the log had dropped before they were read.
    [[nodiscard]] std::uint64_t missed() const;

private:
    struct Parts;
    std::unique_ptr<Parts> m_parts;
};

} // namespace posewire::feed
