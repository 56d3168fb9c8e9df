// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/model/accounting/stream_figures.h"
#include "core/model/session/session_view.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace posewire::model {

void addLosses(LossesByCause& sums, const LossesByCause& more);

/// The figure of a stream that says how much was lost by a cause, by LossCause.
inline constexpr std::array kFigureOfCause{Figure::LostHere, Figure::LostOnNetwork, Figure::LostAtSender,
                                           Figure::LostUnknown, Figure::LostOnWay};
static_assert(kFigureOfCause.size() == kLossCauses);
/// Those that the losses of somebody can have: only who is heard by a probe loses anything on the way from
/// it.
inline std::span<const Figure> causeFiguresOf(const log::SenderInfo& sender) {
    return std::span(kFigureOfCause).first(sender.probe.empty() ? kLossCauses - 1 : kLossCauses);
}

/// What one stream lacks; the sum of all, without what was expected, is what it has lost and what is
/// incomplete.
struct StreamLosses {
    LossesByCause byCause{};
    std::uint64_t pending = 0;  ///< not here yet, and not yet lost: late packets may still bring them
    std::uint64_t underWay = 0; ///< the newest, of which a part has come and the rest may just come
    std::uint64_t expected = 0; ///< samples that should have come, but those; 0 for messages
};

/// Whose losses they were, of all streams of a session in one range of time: read once, then asked for each
/// stream. What is not known to be anybody's is Unknown.
class Losses {
public:
    /// All there is where no range is given. Valid until the session follows the log again.
    Losses(const SessionView& session, const std::optional<TimeRange>& range);

    [[nodiscard]] StreamLosses of(const Stream& stream) const;
    /// Adds a stream to sums of samples; messages (types 10 to 13) are none, and count in their own rows.
    void addTo(LossesByCause& sums, const Stream& stream) const;
    /// Every figure of a stream in the range, with whose losses they were; what is pending is not lost.
    [[nodiscard]] StreamFigures figuresOf(const Stream& stream) const;
    /// Most samples lost in a row, in the range.
    [[nodiscard]] std::uint64_t longestGapOf(const Stream& stream) const;
    /// As model::addParts; what is pending is not lost.
    void addParts(const Stream& stream, const RangeParts& parts, std::span<RangePart> into) const;

private:
    struct Pending {
        std::uint64_t samples = 0;
        std::uint64_t underWay = 0;
        std::uint64_t longest = 0; ///< in a row
        std::uint64_t settled = 0; ///< the longest gap of the newest that is not pending
        std::vector<std::pair<log::Stamp, std::uint64_t>> gaps{}; ///< by when the next sample came
    };
    [[nodiscard]] LossesByCause causesOf(const Stream& stream) const;
    [[nodiscard]] const Pending* pendingOf(const log::StreamKey& stream) const;
    /// Takes what is pending out of what was counted as lost in equal parts of the range.
    void takePending(const log::StreamKey& stream, const RangeParts& parts, std::span<RangePart> from) const;

    std::optional<TimeRange> m_range;
    log::Stamp m_now;
    bool m_isRecording;
    std::unordered_map<log::StreamKey, LossesByCause> m_known; ///< of the range, where there is one
    std::unordered_map<log::StreamKey, Pending> m_pending;
};

/// What was lost for good within a range, finer than the accounting's buckets: each gap, and each sample of
/// which only a part came, when the next one did. What may still come, or turns out never to have been
/// expected, is none.
class SettledLosses {
public:
    SettledLosses(const SessionView& session, const TimeRange& range);

    /// Adds what a stream lost in equal parts of the range.
    void addParts(const log::StreamKey& stream, const RangeParts& parts, std::span<RangePart> into) const;
    /// False where gaps from the beginning of the range are forgotten: then the accounting has to do.
    [[nodiscard]] bool isWhole() const { return m_isWhole; }

private:
    void add(const log::StreamKey& stream, log::Stamp stamp, std::uint32_t samples);

    TimeRange m_range;
    bool m_isWhole = true;
    std::unordered_map<log::StreamKey, std::vector<std::pair<log::Stamp, std::uint32_t>>> m_lost;
};

} // namespace posewire::model
