// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/receiver.h"
#include "app/stage/batch_order.h"
#include "app/stage/server.h"
#include "core/log/clock.h"
#include "core/log/time.h"

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

namespace posewire::stage {

/// A probe as its readers know it.
struct ProbeState {
    std::string name;
    bool isAlive = false;            ///< it was heard of within the last three seconds
    log::Stamp lastHeard{};          ///< of our clock
    std::string version;             ///< of Posewire there
    std::string host;                ///< the name of its computer
    double rateHz = 0;               ///< packets that it had stored, over the last second
    std::uint64_t stored = 0;        ///< packets, since it began
    std::uint64_t received = 0;      ///< packets of it that came here
    std::uint64_t receivedBytes = 0; ///< of these
    std::uint64_t lostOnWay = 0;     ///< packets that it had received, and that did not come here
    std::uint64_t kernelDropped = 0; ///< datagrams that its computer dropped
    std::uint64_t spoolBytes = 0;
    /// Its clock minus ours, by the exchange of least delay of late; the uncertainty is half that delay (RFC
    /// 5905, section 8). Empty if it never answered.
    std::optional<log::Duration> ahead{};
    log::Duration uncertainty{};
    std::string problem; ///< another layout, or another probe of the same name; empty if all is well
};

struct StageChoice {
    ServerChoice servers;
    std::string site;
    std::optional<log::WallTime> since{}; ///< begins with what was stored then; empty: now
};

/// Appends what the probes of a site publish to a log, through its receiver: each packet once, in the order
/// of its probe. Two threads of its own.
class StageReader {
public:
    static constexpr log::Duration kDeadAfter = std::chrono::seconds(3);

    /// Both must outlive it.
    StageReader(net::Receiver& receiver, const log::PacketLog& log, const log::Clock& clock,
                StageChoice choice);
    ~StageReader();
    StageReader(const StageReader&) = delete;
    StageReader& operator=(const StageReader&) = delete;

    // From any thread.
    /// By name.
    [[nodiscard]] std::vector<ProbeState> probes() const;
    /// Names of the probes that fell silent since the last call.
    [[nodiscard]] std::vector<std::string> takeSilent();
    /// The reason if no server answers, with what to do; empty if one does.
    [[nodiscard]] std::string problem() const;

private:
    void read(const std::stop_token& stop);
    bool subscribe();
    void take(const Message& batch);
    void pulse(const std::stop_token& stop);
    void takeHealth(const Message& health);
    void compareClocks(Server& server);
    void setProblem(std::string text);
    [[nodiscard]] std::shared_ptr<Server> server() const;

    net::Receiver& m_receiver;
    const log::PacketLog& m_log;
    const log::Clock& m_clock;
    const StageChoice m_choice;

    // Of the reading thread:
    Subscription m_batches;
    std::uint64_t m_nextInStream = 0; ///< 0 until the first one came
    BatchOrder m_order;

    mutable std::mutex m_mutex; ///< guards what follows
    std::map<std::string, ProbeState> m_probes;
    std::string m_problem;
    std::set<std::string> m_silent;   ///< probes that are known to be
    std::shared_ptr<Server> m_server; ///< null until it was connected once
    std::jthread m_reading;           ///< these use all of the above
    std::jthread m_pulsing;
};

} // namespace posewire::stage
