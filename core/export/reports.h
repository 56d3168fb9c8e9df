// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/session/session_view.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

/// What a session amounts to, for programs and for people.
namespace posewire::exporting {

/// What a session cannot know about itself.
struct MonitorFacts {
    double durationS = 0;
    std::int64_t receiveBufferBytes = 0; ///< the smallest that a socket was granted; 0 without any
    std::vector<std::string> exceeded{}; ///< one line for each limit that was not kept
    std::uint64_t refusedDatagrams = 0;  ///< from those who are not listened to
    bool hasMemory = false;              ///< what is kept, too, which no two runs have in common
};

/// One JSON object without a newline: every sender with its characters, their streams and all their figures.
[[nodiscard]] std::string monitorReport(const model::SessionView& session, const MonitorFacts& facts);

struct StreamReportOptions {
    std::optional<model::TimeRange> range{}; ///< all there is without one; either end may be open
    std::string application{};               ///< name and version of who writes it
    std::vector<std::string> exceeded{};     ///< one line for each limit that was not kept
    std::vector<std::pair<std::string, std::string>> settings{}; ///< what was set, in words
};

/// What a technician attaches to a ticket: one HTML file without anything outside it, light and dark, to be
/// read and to be printed. A verdict in words, plots over time, every figure of every stream, gaps with their
/// causes, events, what the characters said about themselves.
[[nodiscard]] std::string streamReport(const model::SessionView& session, const StreamReportOptions& options);

} // namespace posewire::exporting
