// SPDX-License-Identifier: MIT
#pragma once

#include "core/feed/pose_feed.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

/// The motion of a range of a log, sample by sample. Memory does not grow with the range.
namespace posewire::exporting {

/// `share` is from 0 to 1. Work goes on if the answer is true.
using ExportProgress = std::function<bool(double share)>;

/// When a sample was made, by everything that may tell.
struct SampleMoment {
    std::uint32_t sample = 0;
    std::uint32_t timeCode = 0; ///< ms
    log::Stamp stamp{};         ///< when it was received
    std::uint64_t packet = 0;   ///< that completed it
};

[[nodiscard]] inline SampleMoment momentOf(const model::CharacterPose& pose) {
    return {pose.sample, pose.timeCode, pose.stamp, pose.packet};
}

/// One sample of one character, or the place of one that did not come whole.
struct MotionFrame {
    std::size_t character = 0; ///< its place in the source
    std::uint32_t sample = 0;
    double seconds = 0; ///< since the first sample of all characters: by counters, through restarts by stamps
    const model::CharacterPose* pose = nullptr; ///< null in a gap; without segments where markers are read
    std::span<const feed::Marker> markers{};
    std::uint64_t run = 0;                     ///< counts from 1: a restart of the sender begins the next
    std::optional<wire::TimeCode> timeOfDay{}; ///< type 25 of the sample, if it came

    [[nodiscard]] bool isGap() const { return pose == nullptr; }
};

struct CharacterSurvey {
    std::uint64_t frames = 0; ///< with gaps
    std::uint64_t gaps = 0;
    std::uint64_t restarts = 0;
    std::uint32_t step = 0; ///< of its sample counters; 0 if there is none: no gaps are known then
    double rateHz = 0;      ///< frames a second; a whole number where it is within 0.5 % of one
    log::Stamp first{};
    log::Stamp last{};
    model::SegmentLayout layout{0, 0, 0}; ///< all that any of its samples has
    model::CharacterPose firstPose;
    std::vector<std::uint32_t> markerIds; ///< in the order in which they were first seen

    static constexpr std::size_t kMostMarkers = 1024;

    /// For formats that cannot do without: of a single frame, which has none, MVN's usual one.
    [[nodiscard]] double writtenRateHz() const { return rateHz > 0 ? rateHz : 60; }
};

struct MotionSurvey {
    std::vector<CharacterSurvey> characters; ///< as in the source
    log::Stamp first{};                      ///< of all
};

/// Looks through a range once: what writers must know before the first sample. Each sample goes to `take` as
/// well, if that is set. Fails as cancelled only.
[[nodiscard]] tl::expected<MotionSurvey, log::FileError> surveyMotion(const feed::PoseSource& source,
                                                                      feed::PoseContent content,
                                                                      const ExportProgress& progress,
                                                                      const feed::TakePose& take = {});

/// Hands out all samples of a range: how many packets of it the log had dropped before. Fails as cancelled
/// only.
[[nodiscard]] tl::expected<std::uint64_t, log::FileError> walkMotion(const feed::PoseSource& source,
                                                                     feed::PoseContent content,
                                                                     const feed::TakePose& take,
                                                                     const ExportProgress& progress);

/// Hands out all samples that were surveyed with the gaps between them, those of each character in the order
/// of their counters; of several characters about as they came. A frame is valid during the call. Fails as
/// cancelled only.
[[nodiscard]] tl::expected<void, log::FileError>
readMotion(const feed::PoseSource& source, feed::PoseContent content, const MotionSurvey& survey,
           const std::function<void(const MotionFrame&)>& visit, const ExportProgress& progress);

} // namespace posewire::exporting
