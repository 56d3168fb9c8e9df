// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/program_state.h"
#include "app/gui/driver/ways_out.h"
#include "app/net/allow_list.h"
#include "app/net/receiver.h"
#include "app/stage/stage_options.h"
#include "app/stage/stage_reader.h"
#include "core/log/clock.h"
#include "core/log/packet_log.h"
#include "core/model/session/session_view.h"

#include <deque>
#include <tl/expected.hpp>

#include <future>
#include <map>
#include <vector>

namespace posewire::gui {

/// Everything that the window lets into the log: the receiver with its inputs, and files; and why no
/// packet comes.
class Receiving {
public:
    Receiving(log::PacketLog& log, const log::Clock& clock)
        : m_log(log), m_clock(clock), m_receiver(log, clock), m_waysOut(log, clock) {}

    /// Listens or connects to one more; what is wrong with it is in state(), and it is tried again by
    /// retry().
    void addPort(const InputAddress& port);
    /// In the row that it was in before.
    void addPort(const InputAddress& port, std::size_t row);

    /// The same for what an operator enters: kept only if it can be opened. Returns what went wrong, else
    /// empty.
    [[nodiscard]] QString tryPort(const InputAddress& port);
    /// Puts one in the place of another, or leaves that and says why.
    [[nodiscard]] QString changePort(const InputAddress& from, const InputAddress& to);

    /// False if it was not there.
    bool removePort(const InputAddress& port);

    /// Opens every port that should be open and is not, if that has become possible; to be called now and
    /// then.
    void retry();

    /// Hosts and nets to listen to, on all inputs; none: everyone. Names are looked up beside the window, and
    /// until they are known they are not listened to.
    void listenTo(const QStringList& allowed);
    [[nodiscard]] const QStringList& allowed() const { return m_allowed; }

    /// From now on, what the probes of a stage receive comes into the log as well.
    void readStage(const stage::StageOptions& options);
    /// Names of those that have fallen silent since this was last asked.
    [[nodiscard]] std::vector<std::string> takeSilentProbes() {
        return m_stage != nullptr ? m_stage->takeSilent() : std::vector<std::string>();
    }

    /// `now` is what rates are measured against.
    void measure(log::Stamp now);
    /// Finds out why no characters are seen, at most four times a second; after measure(). What it asks the
    /// system (addresses, packet filter) it asks every three seconds.
    void examine(const model::SessionView& session, log::Stamp now);
    [[nodiscard]] const ReceivingState& state() const { return m_state; }

    /// The first UDP port that is open; 0 if none is.
    [[nodiscard]] std::uint16_t openPort() const { return openPlace().port; }
    /// The same with an address at which this computer reaches it; of none the port is 0.
    [[nodiscard]] net::Endpoint openPlace() const;

    [[nodiscard]] net::Receiver& receiver() { return m_receiver; }
    [[nodiscard]] WaysOut& waysOut() { return m_waysOut; }

    /// Inputs that are open and targets that are forwarded to now.
    [[nodiscard]] InputChoices choices() const;

private:
    struct Rates {
        double datagrams = 0; ///< a second
        double bytes = 0;
    };
    /// Over the last second.
    class RateMeter {
    public:
        Rates add(log::Stamp now, std::uint64_t datagrams, std::uint64_t bytes);

    private:
        struct Totals {
            log::Stamp stamp;
            std::uint64_t datagrams;
            std::uint64_t bytes;
        };
        std::deque<Totals> m_totals;
        Rates m_rates;
    };

    void takeAllowed();
    void open(PortState& state);
    void readStatus();
    [[nodiscard]] std::vector<net::InputStatus> openInputs() const;

    const log::PacketLog& m_log;
    const log::Clock& m_clock;
    ReceivingState m_state;
    net::Receiver m_receiver;
    std::unique_ptr<stage::StageReader> m_stage; ///< null if none is asked
    WaysOut m_waysOut;
    RateMeter m_rates;
    std::map<net::InputId, RateMeter> m_portRates;
    net::ConnectionWatch m_watch;
    log::Stamp m_examined{};
    QStringList m_allowed;
    std::future<net::NetResult<net::AllowList>> m_lookUp;                 ///< of the names in it
    std::vector<std::future<net::NetResult<net::AllowList>>> m_abandoned; ///< no longer wanted
};

} // namespace posewire::gui
