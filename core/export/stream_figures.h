// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/accounting/stream_counts.h"
#include "core/model/session/session_view.h"

#include <array>
#include <optional>

namespace posewire::exporting {

/// A part of a session in time; all of it without bounds.
struct TimeRange {
    std::optional<std::int64_t> fromNs; ///< since 1970-01-01 UTC
    std::optional<std::int64_t> toNs;
    [[nodiscard]] bool isWhole() const { return !fromNs && !toNs; }
};

/// Every figure of one stream, as reports show it.
struct StreamFigures {
    log::StreamKey key;
    model::StreamCounts counts;
    model::LossPattern pattern;
    model::InterArrival arrivals;
    model::ClockFigures clock;
    double rateHz =
        0; ///< samples a second between the first and the last; of types without samples, datagrams
    std::uint64_t malformed = 0;
    /// Samples lost, by model::LossCause.
    std::array<std::uint64_t, model::kLossCauses> lostByCause{};
};

[[nodiscard]] StreamFigures figuresOf(const model::SessionView& session, const model::Stream& stream,
                                      const TimeRange& range = {});

/// The name that was sent; empty where there was none.
[[nodiscard]] std::string sentName(const model::SessionView& session, const model::CharacterKey& key);

/// "udp", "tcp", "file", "performer".
[[nodiscard]] std::string_view transportName(log::Transport transport);

} // namespace posewire::exporting
