// SPDX-License-Identifier: MIT
#include "core/export/stream_figures.h"

#include "core/model/accounting/attribution.h"
#include "core/model/accounting/range_figures.h"

#include <algorithm>
#include <limits>

namespace posewire::exporting {
namespace {

constexpr std::int64_t kBeginning = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kEnd = std::numeric_limits<std::int64_t>::max();

/// Between the first and the last, so that a stream that ended long ago keeps its rate.
double rateOf(const StreamFigures& figures, double seconds) {
    const bool isSampled = model::countsSamples(figures.key.type);
    const std::uint64_t count = isSampled ? figures.counts.samples : figures.counts.datagrams;
    // Messages come seldom and in several datagrams at once: a moment tells nothing of how often.
    const double least = isSampled ? 0 : 1;
    return count > 1 && seconds > least ? static_cast<double>(count - 1) / seconds : 0;
}

/// What is not attributed is unknown.
std::array<std::uint64_t, model::kLossCauses> causesIn(const model::SessionView& session,
                                                       const StreamFigures& figures, const TimeRange& range) {
    std::array<std::uint64_t, model::kLossCauses> causes{};
    std::uint64_t known = 0;
    for (const model::Gap& gap : session.gaps()) {
        if (gap.stream == figures.key && gap.toStampNs >= range.fromNs.value_or(kBeginning) &&
            gap.toStampNs < range.toNs.value_or(kEnd) && gap.cause != model::LossCause::Unknown) {
            causes[static_cast<std::size_t>(gap.cause)] += gap.lost;
            known += gap.lost;
        }
    }
    causes[static_cast<std::size_t>(model::LossCause::Unknown)] =
        figures.counts.lost - std::min(known, figures.counts.lost);
    return causes;
}

} // namespace

StreamFigures figuresOf(const model::SessionView& session, const model::Stream& stream,
                        const TimeRange& range) {
    const model::StreamAccounting& accounting = stream.accounting;
    const model::TimeRange part{range.fromNs.value_or(kBeginning), range.toNs.value_or(kEnd)};
    const model::RangeFigures read =
        model::countedFigures(accounting, range.isWhole() ? std::nullopt : std::optional(part));
    StreamFigures figures;
    figures.key = stream.key;
    figures.counts = read.counts;
    figures.pattern = read.pattern;
    figures.arrivals = read.arrivals;
    figures.clock = read.clock;
    figures.malformed = read.malformed;
    const std::int64_t from = std::max(accounting.firstStampNs(), part.fromNs);
    const std::int64_t to = std::min(accounting.lastStampNs(), part.toNs);
    figures.rateHz = rateOf(figures, static_cast<double>(to - from) * 1e-9);
    figures.lostByCause = range.isWhole() ? stream.lostByCause() : causesIn(session, figures, range);
    return figures;
}

std::string sentName(const model::SessionView& session, const model::CharacterKey& key) {
    const model::MetadataTag* tag = session.metadata(key).find("name");
    return tag != nullptr ? tag->values.back().text : std::string();
}

std::string_view transportName(log::Transport transport) {
    switch (transport) {
    case log::Transport::Udp:
        return "udp";
    case log::Transport::Tcp:
        return "tcp";
    case log::Transport::File:
        return "file";
    case log::Transport::Performer:
        return "performer";
    }
    return "unknown";
}

} // namespace posewire::exporting
