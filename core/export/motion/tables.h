// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/motion/motion_writer.h"

#include <memory>

/// Motion as text for spreadsheets and scripts.
namespace posewire::exporting {

/// One table (RFC 4180, UTF-8, lines end with CR LF), a row for each sample of each character, with the
/// columns
///
///     character,id,run,sample,time (s),received (ns since 1970 UTC),time code (ms),type,
///     Pelvis x (m),Pelvis y (m),Pelvis z (m),Pelvis qw,Pelvis qx,Pelvis qy,Pelvis qz, … all other segments
///
/// `run` counts from 1: a restart of the sender begins the next. `sample` is the sender's counter, `time`
/// counts from the first sample of the file by that, `type` is the message it came in. Positions are of
/// segment origins in the world (Z up), quaternions turn segment coordinates into world coordinates. The row
/// of a sample that did not come whole has no cells after `time`; of a file that does not say when its
/// datagrams were received, `received` is empty; a segment that a sample lacks has empty cells. Columns are
/// those of all segments that any sample has: body, props, left and right fingers.
[[nodiscard]] std::unique_ptr<MotionWriter> makeMotionCsv(const MotionTask& task);

/// One object on each line, in the same order:
///
///     {"character":"…","id":0,"run":1,"sample":1,"time":0.000000,"receivedNs":…,"timeCode":…,"type":"02",
///      "segments":[{"id":1,"name":"Pelvis","position":[x,y,z],"orientation":[w,x,y,z]},…]}
///
/// Units as in the table; "id" of a segment is its place in the message, from 1. Of a sample that did not
/// come whole "segments" is null, and what is between "time" and that is missing; "receivedNs" is missing
/// where the file does not say.
[[nodiscard]] std::unique_ptr<MotionWriter> makeMotionJsonLines(const MotionTask& task);

} // namespace posewire::exporting
