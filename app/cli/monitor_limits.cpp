// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/monitor_limits.h"

#include "core/export/html.h"
#include "core/export/session_reading.h"
#include "core/wire/type_table.h"

#include <algorithm>

namespace posewire::cli {
namespace {

std::string placeOf(const model::SessionView& session, const log::StreamKey& key) {
    const model::Sender* sender = session.find(key.sender);
    return (sender != nullptr ? sender->info.address : std::string("unknown source")) + ", " +
           session.displayName({key.sender, key.character}) + ", type " + wire::typeTitle(key.type);
}

} // namespace

bool Limits::isAny() const {
    return std::ranges::any_of(most, [](const auto& limit) { return limit.has_value(); });
}

std::string unitOf(const Limit& limit) {
    return std::string(" ") + model::rowOf(limit.figure).style.unit;
}

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
        const model::StreamFigures figures = exporting::figuresOf(session, stream);
        for (std::size_t i = 0; i < kLimits.size(); ++i) {
            const double value = figures[kLimits[i].figure];
            if (limits.most[i] && value > *limits.most[i]) {
                lines.push_back(placeOf(session, stream.key) + ": " + std::string(kLimits[i].name) + ' ' +
                                exporting::fixed(value, 3) + unitOf(kLimits[i]) + " is above the limit of " +
                                exporting::fixed(*limits.most[i], 3) + unitOf(kLimits[i]));
            }
        }
    }
    return lines;
}

} // namespace posewire::cli
