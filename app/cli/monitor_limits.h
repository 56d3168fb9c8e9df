// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model/accounting/stream_figures.h"
#include "core/model/session/session_view.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace posewire::cli {

/// A figure that may be limited: `--max-NAME`.
struct Limit {
    std::string_view name;
    model::Figure figure;
    std::string_view help;
};
inline constexpr std::array<Limit, 3> kLimits{
    {{"loss", model::Figure::LossShare, "samples lost or incomplete"},
     {"jitter", model::Figure::Jitter, "jitter as in RFC 3550"},
     {"gap", model::Figure::SpacingMost, "time between successive samples"}}};

/// " %" or " ms", as it follows a number.
[[nodiscard]] std::string unitOf(const Limit& limit);

/// The most that a stream may have of each of kLimits; nothing: anything.
struct Limits {
    std::array<std::optional<double>, kLimits.size()> most;
    [[nodiscard]] bool isAny() const;
};

/// One line for each limit that a stream exceeds; one if nothing was received although there are limits.
[[nodiscard]] std::vector<std::string> exceeded(const model::SessionView& session, const Limits& limits);

} // namespace posewire::cli
