// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/demo_sender.h"

#include "app/net/datagram_sender.h"
#include "core/log/time.h"
#include "core/performer/performer.h"
#include "core/wire/codec.h"

#include <vector>

namespace posewire::gui {

namespace {

/// A sender that fell behind (a sleeping computer) goes on from now instead of flooding the receiver with the
/// past.
constexpr log::Duration kGreatestLag = std::chrono::milliseconds(250);

} // namespace

DemoSender::DemoSender(int characters, std::uint16_t port)
    : m_thread([this, characters, port] { run(characters, port); }) {}

DemoSender::~DemoSender() {
    m_isStopping = true;
    m_thread.join();
}

void DemoSender::run(int characters, std::uint16_t port) {
    auto sender = net::DatagramSender::connect({{"127.0.0.1", port}, net::SendTarget::Transport::Udp});
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
    for (std::uint64_t index = 0; !m_isStopping; ++index) {
        performer.frameInto(index, datagrams);
        const log::Duration late = schedule.waitUntil(skipped + static_cast<std::int64_t>(index) * period);
        if (late > kGreatestLag) {
            skipped += late;
        }
        for (const wire::Datagram& datagram : datagrams) {
            bytes.clear();
            if (wire::encodeInto(datagram, bytes)) {
                // A datagram that the system does not take is one that a network lost; the monitor will tell.
                static_cast<void>(sender->send(bytes));
            }
        }
    }
}

} // namespace posewire::gui
