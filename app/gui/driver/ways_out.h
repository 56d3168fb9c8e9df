// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/program_state.h"
#include "app/outlets/outlet.h"

#include <future>
#include <memory>
#include <utility>
#include <vector>

namespace posewire::gui {

/// Hands what is received on to where the operator wants it, each on or off. Belongs to the window's thread;
/// names are looked up beside it, and its end waits for those that still are.
class WaysOut {
public:
    /// Both must outlive it.
    WaysOut(const log::PacketLog& log, const log::Clock& clock) : m_log(log), m_clock(clock) {}

    /// False if the same is there already.
    bool add(const WayOut& choice) { return add(choice, m_states.size()); }
    /// In the row that it was in before.
    bool add(const WayOut& choice, std::size_t row);
    void remove(std::size_t row);
    void setOn(std::size_t row, bool isOn);

    /// To be called each time after the session of what is received has followed the log.
    void update(const model::SessionView& session);
    /// Returns true if an outlet waits for update(): one of poses that is on.
    [[nodiscard]] bool hasPoses() const;
    /// Reads counters. `inputs` is what is listened to now: a target that would come back by one of them is
    /// stopped and says so.
    void measure(const std::vector<net::InputStatus>& inputs);
    [[nodiscard]] const std::vector<WayOutState>& states() const { return m_states; }

    /// A target that was switched off because its datagrams came back: who sent them, and what is to be said.
    struct Loop {
        log::SenderId returner;
        QString text;
    };
    /// Those found since the last call.
    [[nodiscard]] std::vector<Loop> takeLoops() { return std::exchange(m_loops, {}); }

private:
    using Started = net::NetResult<std::unique_ptr<outlets::Outlet>>;
    /// The outlet of a row, beside its state.
    struct Work {
        const outlets::OutletKind* kind = nullptr; ///< null if this version does not know it
        std::future<Started> answer{};             ///< while the name is looked up
        std::unique_ptr<outlets::Outlet> outlet{};
        WayOutState before{}; ///< counted until it was last switched off
    };

    void begin(std::size_t row);
    void stop(std::size_t row);
    void refuse(std::size_t row, const std::string& problem);
    void takeAnswers();
    void readCounters();
    void stopLoops();
    void heedInputs(const std::vector<net::InputStatus>& inputs);

    const log::PacketLog& m_log;
    const log::Clock& m_clock;
    std::shared_ptr<net::Relay> m_relay; ///< from the first row of datagrams on: it is a thread
    std::vector<WayOutState> m_states;
    std::vector<Work> m_work;
    std::vector<std::future<Started>> m_abandoned; ///< no longer wanted, and not known yet
    std::vector<net::InputStatus> m_inputs;
    std::vector<Loop> m_loops;
};

} // namespace posewire::gui
