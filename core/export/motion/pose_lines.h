// SPDX-License-Identifier: MIT
#pragma once

#include "core/feed/pose_feed.h"

#include <string>

/// Poses as JSON. Metres, Z up; numbers have the fewest digits that read back to the same 32 bits.
namespace posewire::exporting {

/// Appends the segments that a pose has, as the items of an array:
///
///     {"id":1,"name":"Pelvis","position":[x,y,z],"orientation":[w,x,y,z],"from":"sent"},…
///
/// "from" is "sent", "solved" or "assumed", the weaker of position and orientation.
void appendSegments(const model::CharacterPose& pose, std::string& text);

/// One pose as an object without a newline; packaging/formats.md lists its keys. The log is the one that it
/// was read from.
[[nodiscard]] std::string poseLine(const log::PacketLog& log, const feed::PoseCharacter& character,
                                   const feed::PoseSample& sample);

} // namespace posewire::exporting
