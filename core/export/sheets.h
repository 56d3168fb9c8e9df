// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/null_pose.h"
#include "core/model/foreign_text.h"
#include "core/model/incidents/incident.h"
#include "core/model/session/session_view.h"
#include "core/wire/messages.h"

#include <span>
#include <string>

/// Tables that are saved as CSV or JSON.
namespace posewire::exporting {

/// One line of a table of comma-separated values (RFC 4180): cells in quotation marks where they need them,
/// CR LF at the end. Texts that begin like a formula come through model::csvText().
[[nodiscard]] std::string csvLine(std::span<const std::string> cells);

/// Events of a session, in the order given.
struct EventSheet {
    const model::SessionView& session;
    std::span<const model::Incident* const> events;
};

/// One table (RFC 4180, UTF-8, lines end with CR LF) with the columns
///
///     number,severity,group,event,source,characters,types,from,to,firstPacket,lastPacket,count,samples,
///     cause,current,text
///
/// characters and types are lists with a blank between two, such as "1 2"; from and to are seconds since 1970
/// UTC with nine decimals. Cells of what an event is not about are empty.
[[nodiscard]] std::string eventsCsv(const EventSheet& sheet);

/// An array with one object for each event, one on a line, with the keys of the columns but "fromNs" and
/// "toNs" (nanoseconds since 1970 UTC) for from and to. Keys of what an event is not about are missing.
[[nodiscard]] std::string eventsJson(const EventSheet& sheet);

/// The scale messages of one character: what was sent, nothing computed; what was not sent is null. Floats
/// are written with as few digits as distinguish each from its neighbours, so that they read back to the same
/// 32 bits.
struct NullPoseSheet {
    model::ForeignText character; ///< its name
    const model::NullPose* pose = nullptr;
    const wire::ScaleInformation* scale = nullptr; ///< type 10
    const wire::PropInformation* props = nullptr;  ///< type 11
    log::WallTime time{};                          ///< when the newest part of the pose came
};

/// One table (RFC 4180, UTF-8, lines end with CR LF) with the columns
///
///     kind,segment,point,name,flags,x,y,z,m11,m12,m13,m21,m22,m23,m31,m32,m33
///
/// kind is `segment` (type 13: segment counts from 1, name, x y z in metres, Z-up), `point` (type 13:
/// segment, point, name, flags as 0x00000000, x y z from the segment's origin), `scale` (type 10: segment, x
/// y z the offset, m11 to m33 the matrix as sent) or `prop` (type 11: segment, name). Cells that a kind has
/// no value for are empty. What is no number is NaN, Infinity or -Infinity.
[[nodiscard]] std::string nullPoseCsv(const NullPoseSheet& sheet);

/// One object, indented by two spaces:
///
///     {"character": "…", "stampNs": …, "packet": …, "partsReceived": …, "partsExpected": …,
///      "segments": [{"id": 1, "name": "Pelvis", "position": [x, y, z]}, …],
///      "points": [{"segment": 1, "point": 13, "name": "pSacrum", "flags": 0, "position": [x, y, z]}, …],
///      "scale": [{"id": 1, "offset": [x, y, z], "matrix": [9]}, …],
///      "props": [{"id": 24, "name": "Prop1"}, …]}
///
/// Without a null pose the keys from "stampNs" to "points" are missing, without type 10 or 11 "scale" and
/// "props". "stampNs" is nanoseconds since 1970 UTC, of the newest part. What is no number is one of the
/// strings "NaN", "Infinity" and "-Infinity".
[[nodiscard]] std::string nullPoseJson(const NullPoseSheet& sheet);

} // namespace posewire::exporting
