// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/accounting/stream_figures.h"
#include "core/model/session/session_view.h"

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>

namespace posewire::model {

/// Samples by LossCause.
using LossesByCause = std::array<std::uint64_t, kLossCauses>;

/// Whose losses they were, of all streams of a session in one range of time: read once, then asked for each
/// stream. What is not known to be anybody's is Unknown, so that the sum is what the stream lacks.
class Losses {
public:
    /// All there is where no range is given. Valid until the session follows the log again.
    Losses(const SessionView& session, const std::optional<TimeRange>& range);

    [[nodiscard]] LossesByCause of(const Stream& stream) const;
    /// Every figure of a stream in the range, with whose losses they were.
    [[nodiscard]] StreamFigures figuresOf(const Stream& stream) const;

private:
    std::optional<TimeRange> m_range;
    std::unordered_map<log::StreamKey, LossesByCause> m_known;
};

} // namespace posewire::model
