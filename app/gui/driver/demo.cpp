// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/demo.h"

#include "app/net/datagram_sender.h"
#include "core/performer/performer.h"
#include "core/wire/codec.h"

#include <vector>

namespace posewire::gui {

namespace {

/// A demo that fell behind (a sleeping computer) continues from now instead of flooding the receiver with the
/// past.
constexpr log::Duration kGreatestLag = std::chrono::milliseconds(250);

/// The performer as a sender beside the window, until it is asked to stop.
void sendDemo(const std::stop_token& stop, int characters, const net::Endpoint& to) {
    auto sender = net::DatagramSender::connect({to, net::SendTarget::Transport::Udp});
    if (!sender) {
        return;
    }
    performer::PerformerSettings settings;
    settings.characters = characters;
    performer::Performer performer(settings);
    const log::SystemClock clock;
    net::SendSchedule schedule(clock);
    const auto period =
        std::chrono::duration_cast<log::Duration>(log::Duration(std::chrono::seconds(1)) / settings.rateHz);
    std::vector<wire::Datagram> datagrams;
    std::vector<std::byte> bytes;
    log::Duration skipped{};
    for (std::uint64_t index = 0; !stop.stop_requested(); ++index) {
        performer.frameInto(index, datagrams);
        const log::Duration late = schedule.waitUntil(skipped + static_cast<std::int64_t>(index) * period);
        if (late > kGreatestLag) {
            skipped += late;
        }
        for (const wire::Datagram& datagram : datagrams) {
            bytes.clear();
            if (wire::encodeInto(datagram, bytes)) {
                // A datagram that the system does not take counts as one that a network lost.
                static_cast<void>(sender->send(bytes));
            }
        }
    }
}

} // namespace

void Demo::setCharacters(int characters) {
    m_thread = {}; // stops and joins the one that runs
    if (characters > 0) {
        if (m_receiving.openPort() == 0) {
            m_receiving.addPort({QStringLiteral("127.0.0.1"), 0});
        }
        m_thread = std::jthread(sendDemo, characters, m_receiving.openPlace());
    }
    emit changed();
}

} // namespace posewire::gui
