// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/driver/connection_watch.h"
#include "app/gui/driver/relaying.h"
#include "app/gui/receiving_state.h"
#include "app/net/receiver.h"
#include "core/log/clock.h"
#include "core/log/packet_log.h"
#include "core/log/time.h"

#include <deque>
#include <map>

namespace posewire::gui {

/// Everything that the window lets into the log: the receiver with its inputs, and files.
class Receiving {
public:
    Receiving(log::PacketLog& log, const log::Clock& clock)
        : m_clock(clock), m_receiver(log, clock), m_relaying(log, clock) {}

    /// Listens or connects to one more; what is wrong with it is in state(), and it is tried again by
    /// retry().
    void addPort(const InputAddress& port);

    /// The same for what an operator enters: kept only where it can be opened. The answer is what went wrong,
    /// empty for nothing.
    [[nodiscard]] QString tryPort(const InputAddress& port);
    /// Puts one in the place of another, or leaves that and says why.
    [[nodiscard]] QString changePort(const InputAddress& from, const InputAddress& to);

    /// False where it was not there.
    bool removePort(const InputAddress& port);

    /// Opens every port that should be open and is not, where that has become possible. For now and then.
    void retry();

    /// Appends a file of datagrams, beside whatever is received meanwhile. Without stamps of their own they
    /// are spaced by their time codes, the newest being now. The answer is what went wrong, empty for
    /// nothing.
    [[nodiscard]] QString openFile(const QString& path);

    /// `now` is what rates are measured against.
    void measure(log::Stamp now);
    /// Looks why no characters are seen; after measure().
    void examine(const model::SessionView& session, log::Stamp now) {
        m_watch.examine(session, now, m_state);
    }
    [[nodiscard]] const ReceivingState& state() const { return m_state; }

    /// The first UDP port that is open; 0 where none is.
    [[nodiscard]] std::uint16_t openPort() const;

    [[nodiscard]] net::Receiver& receiver() { return m_receiver; }
    [[nodiscard]] Relaying& relaying() { return m_relaying; }

    /// What is open and forwarded to now.
    [[nodiscard]] InputChoices choices() const;

private:
    struct Totals {
        log::Stamp stamp;
        std::uint64_t datagrams;
        std::uint64_t bytes;
    };
    using Window = std::deque<Totals>;

    void open(PortState& state);
    void readStatus();
    void measurePorts(log::Stamp now);
    [[nodiscard]] std::vector<net::InputStatus> openInputs() const;
    /// The oldest of a window of one second that ends with `totals`.
    static const Totals& oldest(Window& window, const Totals& totals);

    const log::Clock& m_clock;
    ReceivingState m_state;
    net::Receiver m_receiver;
    Relaying m_relaying;
    ConnectionWatch m_watch;
    Window m_totals;
    std::map<net::InputId, Window> m_portTotals;
};

} // namespace posewire::gui
