// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/program_state.h"
#include "app/net/relay.h"

#include <future>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace posewire::gui {

/// The hosts that the operator wants everything forwarded to, each on or off. Belongs to the window's
/// thread; names are looked up beside it, and its end waits for those that still are.
class Relaying {
public:
    /// Both must outlive it.
    Relaying(const log::PacketLog& log, const log::Clock& clock) : m_log(log), m_clock(clock) {}

    /// False if that host and port are there already.
    bool add(const RelayChoice& choice) { return add(choice, m_states.size()); }
    /// In the row that it was in before.
    bool add(const RelayChoice& choice, std::size_t row);
    void remove(std::size_t row);
    void setOn(std::size_t row, bool isOn);

    /// Reads counters. `inputs` is what is listened to now: a target that would come back by one of them is
    /// stopped and says so.
    void measure(const std::vector<net::InputStatus>& inputs);
    [[nodiscard]] const std::vector<RelayState>& states() const { return m_states; }

    /// A target that was switched off because its datagrams came back: who sent them, and what is to be said.
    struct Loop {
        log::SenderId returner;
        QString text;
    };
    /// Those found since the last call.
    [[nodiscard]] std::vector<Loop> takeLoops() { return std::exchange(m_loops, {}); }

private:
    using Answer = std::future<net::NetResult<net::RelayId>>;
    /// Beside each state.
    struct Work {
        Answer answer; ///< while the name is looked up
        std::optional<net::RelayId> id;
        RelayState before; ///< counted until it was last switched off
    };

    void begin(std::size_t row);
    void stop(std::size_t row);
    void takeAnswers();
    void dropAbandoned();
    void readCounters();
    void stopLoops();
    void heedInputs(const std::vector<net::InputStatus>& inputs);

    const log::PacketLog& m_log;
    const log::Clock& m_clock;
    std::unique_ptr<net::Relay> m_relay; ///< from the first target on: it is a thread; outlives the answers
    std::vector<RelayState> m_states;
    std::vector<Work> m_work;
    std::vector<Answer> m_abandoned; ///< no longer wanted, and not known yet
    std::vector<net::InputStatus> m_inputs;
    std::vector<Loop> m_loops;
};

} // namespace posewire::gui
