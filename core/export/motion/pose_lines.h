// SPDX-License-Identifier: MIT
#pragma once

#include "core/feed/pose_feed.h"

#include <string>
#include <string_view>

/// Poses as JSON. Metres, Z up; numbers have the fewest digits that read back to the same 32 bits.
namespace posewire::exporting {

/// Appends all that belongs to a pose, to the end of its object. What is an empty text is left out.
///
///     ,"receivedNs":…,"timeCode":…,"timeOfDay":"HH:MM:SS.mmm","type":"02","segments":[
///      {"id":1,"name":"Pelvis","position":[x,y,z],"orientation":[w,x,y,z],"from":"sent"},…]}
///
/// "from" is "sent", "solved" or "assumed", the weaker of position and orientation.
void appendPose(const model::CharacterPose& pose, const std::string& receivedNs, std::string_view timeOfDay,
                std::string& line);

/// One pose as an object without a newline; packaging/formats.md lists its keys. The log is the one that it
/// was read from.
[[nodiscard]] std::string poseLine(const log::PacketLog& log, const feed::PoseCharacter& character,
                                   const feed::PoseSample& sample);

} // namespace posewire::exporting
