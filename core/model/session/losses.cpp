// SPDX-License-Identifier: MIT
#include "core/model/session/losses.h"

#include "core/model/accounting/attribution.h"
#include "core/model/session/accounts.h"

#include <algorithm>

namespace posewire::model {

namespace {

/// Stamps of the log grow, but for those of several sockets, which are less than this apart.
constexpr log::Duration kSocketsApart = std::chrono::seconds(1);
constexpr std::size_t kUnknown = static_cast<std::size_t>(LossCause::Unknown);

} // namespace

void addLosses(LossesByCause& sums, const LossesByCause& more) {
    std::ranges::transform(sums, more, sums.begin(), std::plus());
}

Losses::Losses(const SessionView& session, const std::optional<TimeRange>& range)
    : m_range(range), m_now(session.now()), m_isRecording(session.isRecording()) {
    session.accounts().attribution().forEachPending([&](const PendingLoss& loss) {
        if (!range || (loss.to >= range->from && loss.to < range->to)) {
            Pending& pending = m_pending[loss.stream];
            if (loss.isUnderWay) {
                ++pending.underWay;
                return;
            }
            pending.samples += loss.samples;
            pending.longest = std::max(pending.longest, loss.samples);
            pending.gaps.emplace_back(loss.to, loss.samples);
        }
    });
    if (!m_pending.empty()) {
        for (const Gap& gap : session.accounts().attribution().gaps()) {
            if (const auto pending = m_pending.find(gap.stream); pending != m_pending.end() && gap.isJudged) {
                pending->second.settled = std::max<std::uint64_t>(pending->second.settled, gap.lost);
            }
        }
    }
    if (!range) {
        return;
    }
    // Newest first.
    for (auto one = session.accounts().attribution().gaps().rbegin();
         one != session.accounts().attribution().gaps().rend(); ++one) {
        const Gap& gap = *one;
        if (gap.toStamp + kSocketsApart < range->from) {
            break;
        }
        if (gap.toStamp >= range->from && gap.toStamp < range->to) {
            LossesByCause& known = m_known[gap.stream];
            std::ranges::transform(
                known, gap.shares, known.begin(),
                [](std::uint64_t sum, const Gap::Share& share) { return sum + share.lost; });
        }
    }
    session.accounts().attribution().forEachPartialLoss(
        [&](const log::StreamKey& stream, log::Stamp stamp, LossCause cause, std::uint64_t /*packet*/) {
            if (stamp >= range->from && stamp < range->to && cause != LossCause::Unknown) {
                ++m_known[stream][static_cast<std::size_t>(cause)];
            }
        });
}

const Losses::Pending* Losses::pendingOf(const log::StreamKey& stream) const {
    const auto found = m_pending.find(stream);
    return found == m_pending.end() ? nullptr : &found->second;
}

StreamLosses Losses::of(const Stream& stream) const {
    StreamLosses losses{causesOf(stream)};
    if (const Pending* pending = pendingOf(stream.key)) {
        losses.pending = std::min(losses.byCause[kUnknown], pending->samples);
        losses.byCause[kUnknown] -= losses.pending;
        losses.underWay = std::min(losses.byCause[kUnknown], pending->underWay);
        losses.byCause[kUnknown] -= losses.underWay;
    }
    if (countsSamples(stream.key.type)) {
        losses.expected = stream.accounting.counts(m_range).expected() - losses.pending - losses.underWay;
    }
    return losses;
}

void Losses::addTo(LossesByCause& sums, const Stream& stream) const {
    if (countsSamples(stream.key.type)) {
        addLosses(sums, of(stream).byCause);
    }
}

LossesByCause Losses::causesOf(const Stream& stream) const {
    if (!m_range) {
        return stream.lostByCause();
    }
    const StreamCounts counts = stream.accounting.countsBetween(m_range->from, m_range->to);
    std::uint64_t left = counts.lost + counts.incomplete;
    const auto known = m_known.find(stream.key);
    LossesByCause losses{};
    for (std::size_t cause = 0; known != m_known.end() && cause < kLossCauses; ++cause) {
        losses[cause] = cause == kUnknown ? 0 : std::min(known->second[cause], left); // at an edge, whole
        left -= losses[cause];
    }
    losses[kUnknown] = left;
    return losses;
}

StreamFigures Losses::figuresOf(const Stream& stream) const {
    StreamFigures figures = model::figuresOf(stream, m_range);
    if (m_isRecording) { // the end of a recording is not now
        figures.set(Figure::Rate, figures[Figure::RateWhole]);
    } else if (!m_range) {
        figures.set(Figure::Rate, stream.rateAt(m_now));
    }
    const StreamLosses losses = of(stream);
    for (std::size_t cause = 0; cause < kFigureOfCause.size(); ++cause) {
        figures.set(kFigureOfCause[cause], static_cast<double>(losses.byCause[cause]));
    }
    if (losses.pending + losses.underWay != 0) {
        const auto pending = static_cast<double>(losses.pending);
        const auto underWay = static_cast<double>(losses.underWay);
        const double missing = figures.orZero(Figure::Missing) - pending - underWay;
        figures.set(Figure::Missing, missing);
        figures.set(Figure::Incomplete, std::max(0.0, figures.orZero(Figure::Incomplete) - underWay));
        figures.set(Figure::Lost, std::max(0.0, figures.orZero(Figure::Lost) - pending));
        figures.set(Figure::LossShare, missing > 0 ? 100 * missing / figures.expected() : 0);
        figures.set(Figure::LongestGap, static_cast<double>(longestGapOf(stream)));
    }
    return figures;
}

std::uint64_t Losses::longestGapOf(const Stream& stream) const {
    const std::uint64_t longest = stream.accounting.counts(m_range).longestGapSamples;
    const Pending* pending = pendingOf(stream.key);
    return pending != nullptr && longest <= pending->longest ? std::min(longest, pending->settled) : longest;
}

void Losses::addParts(const Stream& stream, const RangeParts& parts, std::span<RangePart> into) const {
    model::addParts(stream.accounting, parts, into);
    takePending(stream.key, parts, into);
}

void Losses::takePending(const log::StreamKey& stream, const RangeParts& parts,
                         std::span<RangePart> from) const {
    const Pending* pending = parts.count != 0 ? pendingOf(stream) : nullptr;
    if (pending == nullptr) {
        return;
    }
    for (const auto& [stamp, samples] : pending->gaps) {
        if (stamp >= parts.first && stamp < parts.beginOf(parts.count)) {
            RangePart& part = from[static_cast<std::size_t>((stamp - parts.first) / parts.width)];
            part.lost -= static_cast<std::uint32_t>(std::min<std::uint64_t>(part.lost, samples));
        }
    }
}

SettledLosses::SettledLosses(const SessionView& session, const TimeRange& range) : m_range(range) {
    const auto& gaps = session.accounts().attribution().gaps();
    m_isWhole = gaps.size() < Attribution::kMostGaps || gaps.front().toStamp < range.from;
    for (auto gap = gaps.rbegin(); gap != gaps.rend() && gap->toStamp + kSocketsApart >= range.from; ++gap) {
        if (gap->isJudged && gap->lost != 0) {
            add(gap->stream, gap->toStamp, gap->lost);
        }
    }
    session.accounts().attribution().forEachPartialLoss(
        [this](const log::StreamKey& stream, log::Stamp stamp, LossCause /*cause*/,
               std::uint64_t /*packet*/) { add(stream, stamp, 1); });
}

void SettledLosses::add(const log::StreamKey& stream, log::Stamp stamp, std::uint32_t samples) {
    if (stamp >= m_range.from && stamp < m_range.to) {
        m_lost[stream].emplace_back(stamp, samples);
    }
}

void SettledLosses::addParts(const log::StreamKey& stream, const RangeParts& parts,
                             std::span<RangePart> into) const {
    const auto lost = m_lost.find(stream);
    if (lost == m_lost.end() || parts.count == 0) {
        return;
    }
    for (const auto& [stamp, samples] : lost->second) {
        if (stamp >= parts.first && stamp < parts.beginOf(parts.count)) {
            into[static_cast<std::size_t>((stamp - parts.first) / parts.width)].lost += samples;
        }
    }
}

} // namespace posewire::model
