// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/monitor_limits.h"

#include "core/export/html.h"
#include "core/wire/type_table.h"

#include <algorithm>

namespace posewire::cli {
namespace {

struct Judged {
    std::string what;
    std::string unit;
    double value = 0;
    std::optional<double> limit;
};

std::string placeOf(const model::SessionView& session, const log::StreamKey& key) {
    const model::Sender* sender = session.find(key.sender);
    return (sender != nullptr ? sender->info.address : std::string("unknown source")) + ", " +
           session.displayName({key.sender, key.character}) + ", type " + wire::typeTitle(key.type);
}

} // namespace

std::vector<std::string> exceeded(const model::SessionView& session, const Limits& limits) {
    std::vector<std::string> lines;
    if (limits.isAny() && session.streams().empty()) {
        lines.emplace_back(
            "no datagram was received, so no limit is kept; is the sender on, and does it send here?");
    }
    for (const model::Stream& stream : session.streams()) {
        if (!wire::isSampled(stream.key.type)) {
            continue; // sent again now and then: its gaps mean nothing
        }
        const exporting::StreamFigures figures = exporting::figuresOf(session, stream);
        const std::initializer_list<Judged> judged{
            {"loss", " %", 100 * figures.counts.lossRatio(), limits.lossPercent},
            {"jitter", " ms", figures.clock.jitterMs, limits.jitterMs},
            {"gap", " ms", figures.arrivals.mostMs, limits.gapMs}};
        for (const Judged& one : judged) {
            if (one.limit && one.value > *one.limit) {
                lines.push_back(placeOf(session, stream.key) + ": " + one.what + ' ' +
                                exporting::fixed(one.value, 3) + one.unit + " is above the limit of " +
                                exporting::fixed(*one.limit, 3) + one.unit);
            }
        }
    }
    return lines;
}

} // namespace posewire::cli
