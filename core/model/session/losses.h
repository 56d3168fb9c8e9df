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
void addLosses(LossesByCause& sums, const LossesByCause& more);

/// The figure of a stream that says how much was lost by a cause, by LossCause.
inline constexpr std::array kFigureOfCause{Figure::LostHere, Figure::LostOnNetwork, Figure::LostAtSender,
                                           Figure::LostUnknown};
static_assert(kFigureOfCause.size() == kLossCauses);

/// What one stream lacks; the sum of all is what it has lost and what is incomplete.
struct StreamLosses {
    LossesByCause byCause{};
    std::uint64_t pending = 0; ///< not here yet, and not yet lost: late packets may still bring them
};

/// Whose losses they were, of all streams of a session in one range of time: read once, then asked for each
/// stream. What is not known to be anybody's is Unknown.
class Losses {
public:
    /// All there is where no range is given. Valid until the session follows the log again.
    Losses(const SessionView& session, const std::optional<TimeRange>& range);

    [[nodiscard]] StreamLosses of(const Stream& stream) const;
    /// Every figure of a stream in the range, with whose losses they were; what is pending is nobody's.
    [[nodiscard]] StreamFigures figuresOf(const Stream& stream) const;

private:
    [[nodiscard]] LossesByCause causesOf(const Stream& stream) const;

    std::optional<TimeRange> m_range;
    std::unordered_map<log::StreamKey, LossesByCause> m_known; ///< of the range, where there is one
    std::unordered_map<log::StreamKey, std::uint64_t> m_pending;
};

} // namespace posewire::model
