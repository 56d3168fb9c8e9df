// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/stage/batch.h"
#include "app/stage/server.h"
#include "app/stage/spool.h"
#include "core/log/clock.h"
#include "core/log/log_reader.h"
#include "core/log/packet_log.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>

namespace posewire::stage {

struct ProbeChoice {
    ServerChoice servers;
    std::string site;
    std::string name;
    std::string spoolFolder;
    std::uint64_t spoolMost = std::uint64_t{1} << 30; ///< bytes
};

struct ProbeFigures {
    std::uint64_t stored = 0;     ///< packets that a server has
    std::uint64_t waiting = 0;    ///< packets of the log that none has yet
    std::uint64_t gone = 0;       ///< packets that had to go before a server took them: the spool was full
    std::uint64_t spoolBytes = 0; ///< on the disk
    std::string problem;          ///< why nothing is stored just now, what to do; empty if all is well
    std::string refusal;          ///< a permission that the server denied; empty if it denied none
    bool hasTwin = false;         ///< another probe has the same name
};

/// Publishes the packets of a log in order. Each batch is acknowledged before the next is sent, so none is
/// lost, doubled or out of order, whichever server dies. The spool keeps them while no server answers. Two
/// threads of its own.
class Probe {
public:
    /// A batch is closed once it has as many packets, or its first one is that old.
    static constexpr std::uint64_t kBatch = 64;
    static constexpr log::Duration kWait = std::chrono::milliseconds(5);

    /// `health` returns the health of the receiver as a JSON object; another thread calls it once a second.
    /// `log` and `clock` must outlive the probe.
    Probe(log::PacketLog& log, const log::Clock& clock, ProbeChoice choice,
          std::function<std::string()> health);
    /// Tries for two seconds to publish the rest, and leaves in the spool what no server took.
    ~Probe();
    Probe(const Probe&) = delete;
    Probe& operator=(const Probe&) = delete;

    // From any thread.
    [[nodiscard]] ProbeFigures figures() const;

private:
    void publish(const std::stop_token& stop);
    bool connect();
    bool publishLeft(const std::stop_token& stop);
    /// Gathers the next batch. Returns false if it is not due yet.
    bool fill(bool isEnding);
    bool store(const Batch& batch, const std::string& run, const std::stop_token& stop);
    std::optional<log::FileError> beginSpool();
    void note(std::string problem);
    void pulse(const std::stop_token& stop);
    [[nodiscard]] std::string healthText() const;
    [[nodiscard]] std::shared_ptr<Server> server() const;

    log::PacketLog& m_log;
    const log::Clock& m_clock;
    const ProbeChoice m_choice;
    const std::function<std::string()> m_health;
    const std::string m_subject; ///< "posewire.SITE.NAME."
    const std::string m_run = newRun();

    // Of the publishing thread:
    log::LogReader m_reader;
    log::SenderFinder m_senders;
    Spool m_spool;
    Batch m_batch;
    std::uint64_t m_next = 0;                                   ///< packet to be stored
    std::set<std::pair<log::Transport, std::uint16_t>> m_heard; ///< ports that have had a packet in this run
    log::Moment m_failingSince = log::Moment::max();
    log::Duration m_rest{}; ///< until the next batch is due

    mutable std::mutex m_mutex; ///< guards what follows
    ProbeFigures m_figures;
    std::shared_ptr<Server> m_server; ///< null until it was connected once
    std::jthread m_publishing;        ///< these use all of the above
    std::jthread m_pulsing;
};

} // namespace posewire::stage
