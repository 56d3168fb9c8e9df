// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/session/session_view.h"

#include <string>
#include <vector>

namespace posewire::exporting {

/// What a session cannot know about itself.
struct MonitorFacts {
    double durationS = 0;
    std::int64_t receiveBufferBytes = 0; ///< the smallest that a socket was granted; 0 without any
    std::vector<std::string> exceeded{}; ///< one line for each limit that was not kept
};

/// One JSON object without a newline: every sender with its characters, their streams and all their figures.
[[nodiscard]] std::string monitorReport(const model::SessionView& session, const MonitorFacts& facts);

} // namespace posewire::exporting
