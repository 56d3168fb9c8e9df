// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/session/session_view.h"

#include <span>
#include <string>

/// Events of a session as a file, in the order given.
namespace posewire::exporting {

/// One table (RFC 4180, UTF-8, lines end with CR LF) with the columns
///
///     number,severity,group,event,sender,character,type,from,to,firstPacket,lastPacket,count,samples,cause,
///     current,text
///
/// from and to are seconds since 1970 UTC with nine decimals. Cells of what an event is not about are empty.
[[nodiscard]] std::string eventsCsv(const model::SessionView& session,
                                    std::span<const model::Event* const> events);

/// An array with one object for each event, one on a line, with the keys of the columns but "fromNs" and
/// "toNs" (nanoseconds since 1970 UTC) for from and to. Keys of what an event is not about are missing.
[[nodiscard]] std::string eventsJson(const model::SessionView& session,
                                     std::span<const model::Event* const> events);

/// "info", "warning", "error".
[[nodiscard]] std::string_view nameOf(model::EventSeverity severity);
/// "source", "loss", "content", "limit".
[[nodiscard]] std::string_view nameOf(model::EventGroup group);

} // namespace posewire::exporting
