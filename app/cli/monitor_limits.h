// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/export/stream_figures.h"

#include <optional>
#include <string>
#include <vector>

namespace posewire::cli {

/// What a stream may have at most; nothing: anything.
struct Limits {
    std::optional<double> lossPercent; ///< samples lost or incomplete, of those expected
    std::optional<double> jitterMs;    ///< RFC 3550, at the end
    std::optional<double> gapMs;       ///< longest time between the arrivals of successive samples
    [[nodiscard]] bool isAny() const { return lossPercent || jitterMs || gapMs; }
};

/// One line for each limit that a stream exceeds; one if nothing was received although there are limits.
[[nodiscard]] std::vector<std::string> exceeded(const model::SessionView& session, const Limits& limits);

} // namespace posewire::cli
