// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet_log.h"
#include "core/model/body/null_pose.h"
#include "core/model/body/pose_messages.h"
#include "core/model/body/pose_remark.h"
#include "core/model/session/metadata.h"
#include "core/model/session/session_view.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace posewire::feed {

/// A performer's body from one packet on.
struct PoseBody {
    std::uint64_t firstPacket = 0;
    model::BodyOrigins origins{};
};

/// A character whose poses are read, through restarts of its sender.
struct PoseCharacter {
    /// The same character under one sender.
    struct Part {
        model::CharacterKey key;
        std::array<model::LengthUnit, model::kPoseTypes.size()> units{}; ///< of positions
        std::array<bool, model::kPoseTypes.size()> isUnframed{};         ///< see StreamAccounting
        model::UpAxis up = model::UpAxis::Z;
        bool sendsTimeOfDay = false; ///< type 25
    };

    model::CharacterKey key;
    model::ForeignText name;
    bool hasReceipt = true; ///< stamps are of receipt; a file of datagrams alone has none
    model::Colour colour;
    std::vector<Part> parts;                 ///< the oldest first
    std::vector<PoseBody> bodies;            ///< the oldest first, at least one
    model::PoseRemark remark;                ///< what its newest pose lacks, and what stands in
    std::optional<model::NullPose> nullPose; ///< the one that held at the end of the range, else the newest

    /// As the viewport draws it when a packet has come: of the newest scale message by then. Before the first
    /// of these its body holds; without any, the one that was measured on poses, else the reference body.
    [[nodiscard]] const model::BodyOrigins& bodyAt(std::uint64_t packet) const;
    /// The body at the end of the range.
    [[nodiscard]] const model::BodyOrigins& body() const { return bodies.back().origins; }
};

/// All that is needed of a session to read the poses of a range, by value: another thread may read them while
/// the session moves on.
struct PoseSource {
    const log::PacketLog* log = nullptr; ///< outlives this
    std::uint64_t firstPacket = 0;
    std::uint64_t endPacket = 0; ///< UINT64_MAX: goes on with what is received
    std::vector<PoseCharacter> characters;
};

/// The characters named, each with those that it took over from; those that the session does not list are
/// left out.
[[nodiscard]] PoseSource poseSourceOf(const model::SessionView& session, const model::TimeRange& range,
                                      std::span<const model::CharacterKey> characters);

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
    /// A sample waits this long for those before it, and for its other messages.
    static constexpr log::Duration kWait = std::chrono::seconds(4);

    /// Live samples are handed out after `wait` at the latest.
    PoseFeed(PoseSource source, PoseContent content, log::Duration wait = kWait);
    ~PoseFeed();
    PoseFeed(const PoseFeed&) = delete;
    PoseFeed& operator=(const PoseFeed&) = delete;

    /// Takes the characters as a session knows them that has followed the log to the end of `newest`: this
    /// reads up to there, at most to the end of its own source. Samples that wait go on waiting.
    void update(PoseSource newest);
    /// Valid until the next update.
    [[nodiscard]] const PoseCharacter& characterOf(const PoseSample& sample) const;

    /// Reads on for some packets; false if there were none left for now. At the end of the source's range all
    /// samples are handed out, before that those that have waited at `now`.
    bool advance(const TakePose& take, log::Stamp now = {});
    /// From 0 to 1.
    [[nodiscard]] double share() const;
    /// Packets of the range that the log had dropped before they were read.
    [[nodiscard]] std::uint64_t missed() const;

private:
    struct Parts;
    std::unique_ptr<Parts> m_parts;
};

} // namespace posewire::feed
