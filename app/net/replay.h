// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/datagram_sender.h"
#include "core/log/clock.h"
#include "core/log/log_reader.h"
#include "core/log/packet_log.h"

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

namespace posewire::net {

struct ReplayChoice {
    static constexpr double kSlowest = 0.05;
    static constexpr double kFastest = 16;
    SendTarget target;
    std::uint64_t begin = 0; ///< packets from here
    std::uint64_t end = 0;   ///< to before this one
    double speed = 1;        ///< times as fast as they were received
    bool isLooping = false;
};

struct ReplayFigures {
    std::uint64_t position = 0; ///< the next packet
    std::uint64_t sent = 0;
    std::uint64_t refused = 0; ///< by this system
    std::uint64_t missing = 0; ///< not in the log any more when they were due
    std::uint64_t rounds = 0;  ///< that were sent to their end
    bool isOver = false;
    std::string problem{}; ///< why it ended too early; empty if all is well
};

/// Sends packets of a log once more, as far apart as they were received, in a thread of its own. All are due
/// from one fixed start, so that nothing adds up to drift; a round begins one mean interval after the one
/// before. Bytes that belong to no datagram are left out. What is due at once is sent at once: a receiver
/// that is slower makes TCP late, and loses UDP.
class Replay {
public:
    /// Begins with the connection. Both must outlive it.
    Replay(const log::PacketLog& log, const log::Clock& clock, ReplayChoice choice);
    /// Stops in the middle.
    ~Replay();
    Replay(const Replay&) = delete;
    Replay& operator=(const Replay&) = delete;

    [[nodiscard]] const ReplayChoice& choice() const { return m_choice; }
    // From any thread.
    [[nodiscard]] ReplayFigures figures() const;

private:
    void run(const std::stop_token& stop);
    NetResult<void> sendRound(DatagramSender& sender, const std::stop_token& stop);
    /// False if it is to end.
    bool waitFor(log::Duration due, const std::stop_token& stop);
    void note(const DatagramSender& sender, std::uint64_t position, std::uint64_t missing);

    const ReplayChoice m_choice;
    const log::Clock& m_clock;
    log::LogReader m_reader;
    log::Moment m_start;
    log::Duration m_roundBegin{}; ///< since the start
    mutable std::mutex m_mutex;   ///< guards the figures
    std::condition_variable_any m_changed;
    ReplayFigures m_figures;
    std::jthread m_thread; ///< last: it uses all of the above
};

} // namespace posewire::net
