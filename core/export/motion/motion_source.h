// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet_log.h"
#include "core/model/body/character_pose.h"
#include "core/model/body/null_pose.h"
#include "core/model/body/reference_body.h"
#include "core/model/body/units.h"
#include "core/model/session/session_view.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace posewire::exporting {

inline constexpr std::uint8_t kMarkerType = 3;

/// A character to be exported, through restarts of its sender.
struct MotionCharacter {
    /// What one sender sent of it.
    struct Part {
        model::CharacterKey key;
        std::array<model::LengthUnit, model::kWholePoseTypes.size()> poseUnits{}; ///< in their order
        model::LengthUnit markerUnit = model::LengthUnit::Centimetre;
    };

    model::CharacterKey key;
    model::ForeignText name;
    bool hasReceipt = true; ///< stamps are when it was received; a file of datagrams alone does not know
    model::Colour colour;
    std::vector<Part> parts;   ///< the oldest first
    model::BodyOrigins body{}; ///< in the null pose, metres; the reference body's where none came
    std::optional<model::NullPose> nullPose; ///< the one that held at the end of the range, else the newest
};

/// All that is needed of a session to read the motion of a range, by value: it may be read on another thread
/// while the session moves on.
struct MotionSource {
    const log::PacketLog* log = nullptr; ///< outlives this
    std::uint64_t firstPacket = 0;
    std::uint64_t endPacket = 0;
    std::vector<MotionCharacter> characters;
};

/// Of the characters named, each with what it took over from; those that the session does not list are left
/// out.
[[nodiscard]] MotionSource motionSourceOf(const model::SessionView& session, const model::TimeRange& range,
                                          std::span<const model::CharacterKey> characters);

} // namespace posewire::exporting
