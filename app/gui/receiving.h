// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/receiving_state.h"
#include "app/net/udp_receiver.h"
#include "core/log/clock.h"
#include "core/log/packet_log.h"

#include <deque>
#include <memory>

namespace posewire::gui {

/// Everything that writes the log: the receiving thread with its ports, and files, one at a time.
class Receiving {
public:
    Receiving(log::PacketLog& log, const log::Clock& clock) : m_log(log), m_clock(clock) {}

    /// Listens on one more port; what is wrong with it is in state(), and it is tried again by tick().
    void addPort(const UdpPort& port);

    /// What would keep a port from being opened; empty for nothing.
    [[nodiscard]] static QString problemOf(const UdpPort& port);

    /// Opens every port that should be open and is not, where that has become possible. For now and then.
    void retry();

    /// Appends a file of raw datagrams. They are spaced by their time codes, the newest being now. The answer
    /// is what went wrong, empty for nothing.
    [[nodiscard]] QString openFile(const QString& path);

    /// `nowNs` is what rates are measured against.
    void measure(std::int64_t nowNs);
    [[nodiscard]] const ReceivingState& state() const { return m_state; }

    /// The first port that is open; 0 where none is.
    [[nodiscard]] std::uint16_t openPort() const;

private:
    struct Totals {
        std::int64_t stampNs;
        std::uint64_t datagrams;
        std::uint64_t bytes;
    };

    void listen();
    [[nodiscard]] std::vector<net::Endpoint> endpointsThatOpen();
    void takePortNumbers();
    void addCounters();

    log::PacketLog& m_log;
    const log::Clock& m_clock;
    ReceivingState m_state;
    std::unique_ptr<net::UdpReceiver> m_receiver;
    /// Of receivers that have ended.
    std::uint64_t m_datagramsBefore = 0;
    std::uint64_t m_bytesBefore = 0;
    std::uint64_t m_droppedBefore = 0;
    std::deque<Totals> m_totals;
};

} // namespace posewire::gui
