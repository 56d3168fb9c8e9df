// SPDX-License-Identifier: MIT
#include "core/model/session/losses.h"

#include "core/model/accounting/gap.h"

#include <algorithm>

namespace posewire::model {

namespace {

constexpr std::size_t kUnknown = static_cast<std::size_t>(LossCause::Unknown);

} // namespace

void addLosses(LossesByCause& sums, const LossesByCause& more) {
    std::ranges::transform(sums, more, sums.begin(), std::plus());
}

Losses::Losses(const SessionView& session, const std::optional<TimeRange>& range) : m_range(range) {
    session.forEachPending(
        [&](const log::StreamKey& stream, std::uint64_t missing, log::Stamp /*from*/, log::Stamp to) {
            if (!range || (to >= range->from && to < range->to)) {
                m_pending[stream] += missing;
            }
        });
    if (!range) {
        return;
    }
    // Newest first: stamps grow, but for those of several sockets.
    constexpr log::Duration kApart = std::chrono::seconds(1);
    for (auto one = session.gaps().rbegin(); one != session.gaps().rend(); ++one) {
        const Gap& gap = *one;
        if (gap.toStamp + kApart < range->from) {
            break;
        }
        if (gap.toStamp >= range->from && gap.toStamp < range->to && gap.cause != LossCause::Unknown) {
            m_known[gap.stream][static_cast<std::size_t>(gap.cause)] += gap.lost;
        }
    }
    session.forEachPartialLoss([&](const log::StreamKey& stream, log::Stamp stamp, LossCause cause) {
        if (stamp >= range->from && stamp < range->to && cause != LossCause::Unknown) {
            ++m_known[stream][static_cast<std::size_t>(cause)];
        }
    });
}

StreamLosses Losses::of(const Stream& stream) const {
    StreamLosses losses{causesOf(stream)};
    if (const auto missing = m_pending.find(stream.key); missing != m_pending.end()) {
        losses.pending = std::min(losses.byCause[kUnknown], missing->second);
        losses.byCause[kUnknown] -= losses.pending;
    }
    return losses;
}

/// What is pending is Unknown.
LossesByCause Losses::causesOf(const Stream& stream) const {
    if (!m_range) {
        return stream.lostByCause();
    }
    const StreamCounts counts = stream.accounting.countsBetween(m_range->from, m_range->to);
    std::uint64_t left = counts.lost + counts.incomplete;
    const auto known = m_known.find(stream.key);
    LossesByCause losses{};
    for (std::size_t cause = 0; known != m_known.end() && cause < kUnknown; ++cause) {
        losses[cause] = std::min(known->second[cause], left); // a gap at an edge counts whole
        left -= losses[cause];
    }
    losses[kUnknown] = left;
    return losses;
}

StreamFigures Losses::figuresOf(const Stream& stream) const {
    StreamFigures figures = model::figuresOf(stream, m_range);
    const LossesByCause losses = of(stream).byCause;
    for (std::size_t cause = 0; cause < kFigureOfCause.size(); ++cause) {
        figures.set(kFigureOfCause[cause], static_cast<double>(losses[cause]));
    }
    return figures;
}

} // namespace posewire::model
