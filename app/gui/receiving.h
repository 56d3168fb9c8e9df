// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/receiving_state.h"
#include "app/net/receiver.h"
#include "core/log/clock.h"
#include "core/log/packet_log.h"

#include <deque>

namespace posewire::gui {

/// Everything that the window lets into the log: the receiver with its inputs, and files.
class Receiving {
public:
    Receiving(log::PacketLog& log, const log::Clock& clock) : m_clock(clock), m_receiver(log, clock) {}

    /// Listens or connects to one more; what is wrong with it is in state(), and it is tried again by
    /// retry().
    void addPort(const InputAddress& port);

    /// False where it was not there.
    bool removePort(const InputAddress& port);

    /// What would keep a UDP port from being opened; empty for nothing, and for TCP.
    [[nodiscard]] static QString problemOf(const InputAddress& port);

    /// Opens every port that should be open and is not, where that has become possible. For now and then.
    void retry();

    /// Appends a file of datagrams, beside whatever is received meanwhile. Without stamps of their own they
    /// are spaced by their time codes, the newest being now. The answer is what went wrong, empty for
    /// nothing.
    [[nodiscard]] QString openFile(const QString& path);

    /// `nowNs` is what rates are measured against.
    void measure(std::int64_t nowNs);
    [[nodiscard]] const ReceivingState& state() const { return m_state; }

    /// The first UDP port that is open; 0 where none is.
    [[nodiscard]] std::uint16_t openPort() const;

    [[nodiscard]] net::Receiver& receiver() { return m_receiver; }

private:
    struct Totals {
        std::int64_t stampNs;
        std::uint64_t datagrams;
        std::uint64_t bytes;
    };

    void open(PortState& state);
    void readStatus();

    const log::Clock& m_clock;
    ReceivingState m_state;
    net::Receiver m_receiver;
    std::deque<Totals> m_totals;
};

} // namespace posewire::gui
