// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/send_options.h"
#include "core/wire/codec.h"

#include <cmath>
#include <limits>

namespace posewire::cli {
namespace {

/// Further characters of the same numbers, each with a performance of its own.
std::vector<performer::Performer> performersOf(const performer::PerformerSettings& settings,
                                               std::size_t count) {
    std::vector<performer::Performer> performers;
    for (std::size_t number = 0; number < count; ++number) {
        performer::PerformerSettings own = settings;
        own.seed += number;
        performers.emplace_back(std::move(own));
    }
    return performers;
}

void offer(const std::vector<wire::Datagram>& frame, log::Duration due, performer::Faults& faults) {
    for (const wire::Datagram& datagram : frame) {
        // The performer makes nothing that does not fit.
        if (auto bytes = wire::encode(datagram)) {
            faults.offer(std::move(*bytes), due);
        }
    }
}

} // namespace

ExitStatus sendPerformance(const SendOptions& options, const performer::PerformerSettings& settings,
                           std::vector<SendLine>& lines, Console& console) {
    std::vector<performer::Performer> performers = performersOf(settings, lines.size());
    std::vector<wire::Datagram> frame;
    const log::SystemClock clock;
    net::SendSchedule schedule(clock);
    SendRound round(lines, schedule);
    const auto due = [&](std::uint64_t index) {
        return log::Duration(static_cast<std::int64_t>(static_cast<double>(index) * 1e9 / settings.rateHz));
    };
    const double frames = options.durationSeconds > 0.0
                              ? std::round(options.durationSeconds * settings.rateHz)
                              : std::numeric_limits<double>::infinity();
    net::NetResult<void> sent;
    for (std::uint64_t index = 0; sent && static_cast<double>(index) < frames; ++index) {
        for (std::size_t line = 0; line < lines.size(); ++line) {
            performers[line].frameInto(index, frame);
            offer(frame, due(index), lines[line].faults());
        }
        sent = round.sendUntil(due(index + 1));
    }
    if (sent) {
        sent = round.sendRest();
    }
    if (!sent) {
        console.complain(sent.error().text);
        return ExitStatus::Unusable;
    }
    return ExitStatus::Fine;
}

} // namespace posewire::cli
