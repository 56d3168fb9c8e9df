// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet_log.h"
#include "core/model/body/null_pose.h"
#include "core/model/body/pose_messages.h"
#include "core/model/body/pose_remark.h"
#include "core/model/session/metadata.h"
#include "core/model/session/session_view.h"

#include <array>
#include <cstdint>
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

} // namespace posewire::feed
