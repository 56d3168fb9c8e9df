// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/send_options.h"
#include "app/net/send_schedule.h"
#include "core/wire/codec.h"

#include <cmath>

namespace posewire::cli {
namespace {

net::NetResult<void> sendAll(const std::vector<wire::Datagram>& datagrams, net::DatagramSender& sender) {
    std::vector<std::byte> bytes;
    for (const wire::Datagram& datagram : datagrams) {
        if (!wire::encodeInto(datagram, bytes)) {
            continue; // the performer makes nothing that does not fit
        }
        if (auto sent = sender.send(bytes); !sent) {
            return sent;
        }
    }
    return {};
}

} // namespace

ExitStatus sendPerformance(const SendOptions& options, const performer::PerformerSettings& settings,
                           net::DatagramSender& sender, Console& console) {
    performer::Performer performer(settings);
    std::vector<wire::Datagram> frame;
    const log::SystemClock clock;
    net::SendSchedule schedule(clock);
    const double frames = std::round(options.durationSeconds * settings.rateHz);
    for (std::uint64_t index = 0; options.durationSeconds <= 0.0 || static_cast<double>(index) < frames;
         ++index) {
        performer.frameInto(index, frame);
        schedule.waitUntil(static_cast<std::int64_t>(static_cast<double>(index) * 1e9 / settings.rateHz));
        if (const auto sent = sendAll(frame, sender); !sent) {
            console.complain(sent.error().text);
            return ExitStatus::Unusable;
        }
    }
    return ExitStatus::Fine;
}

} // namespace posewire::cli
