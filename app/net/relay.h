// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/command_queue.h"
#include "app/net/endpoint.h"
#include "app/net/input.h"
#include "app/net/loop_watch.h"
#include "core/log/clock.h"
#include "core/log/log_reader.h"
#include "core/log/packet_log.h"
#include "core/log/time.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <unordered_map>
#include <vector>

namespace posewire::net {

/// Identifies a host that gets every datagram; never reused.
enum class RelayId : std::uint32_t {};

/// Of the live datagrams that came since it was added, each is sent, refused, skipped, or still behind.
struct RelayTarget {
    RelayId id{};
    Endpoint endpoint;
    std::uint64_t sent = 0;
    /// By this system: no route, or too long for UDP. By the other: nobody listens there, as far as it says
    /// so (ICMP; some say it of each datagram, some at most once a second, some never).
    std::uint64_t refused = 0;
    std::uint64_t skipped = 0; ///< left out: fallen too far behind, or for fear of a loop
    std::uint64_t behind = 0;  ///< packets of the log that wait to be looked at
    std::string problem;       ///< why the newest was refused, why nothing is sent, or that nobody has
                               ///< listened there for a second; empty if all is well
    bool isStopped = false;    ///< its datagrams came back: nothing is sent or counted any more
    log::SenderId returner{};  ///< who sent them back, if it is stopped
};

/// Forwards every received datagram unchanged to other hosts by UDP. It follows the log in a thread of its
/// own, so it never delays receiving. Packets from files are not forwarded. Targets can be added and removed
/// while it runs. One whose datagrams come back is stopped, and says so (see LoopWatch). Every member may be
/// called from any thread.
class Relay {
public:
    /// Further behind than this many packets it skips some: old data is useless to someone who wants it live.
    static constexpr std::uint64_t kMostBehind = 20'000;

    /// Somebody who is restarted is back by then.
    static constexpr log::Duration kUnheardAfter = std::chrono::seconds(1);
    /// Nothing refused for so long, while something was sent: somebody listens.
    static constexpr log::Duration kHeardAfter = std::chrono::seconds(3);

    /// Both must outlive it.
    Relay(const log::PacketLog& log, const log::Clock& clock)
        : m_log(log), m_clock(clock), m_follower(log), m_thread([this] { run(); }) {}
    ~Relay();

    /// Forwards from now on. Resolves names, which may take seconds. Refuses a port that one of `inputs`
    /// listens on, since every datagram would come back and circulate forever.
    NetResult<RelayId> add(const Endpoint& target, const std::vector<InputStatus>& inputs);

    /// Why a target cannot stay with these inputs; empty if it can, or if there is no such target.
    [[nodiscard]] std::optional<NetError> problemWith(RelayId id,
                                                      const std::vector<InputStatus>& inputs) const;

    bool remove(RelayId id);
    [[nodiscard]] std::vector<RelayTarget> targets() const;

private:
    struct Target;
    enum class Verdict : std::uint8_t { Forward, Ignore };

    void run();
    void wake();
    bool forwardSome();
    void skipWhatIsOld();
    void countOvertaken();
    void forward(const log::Packet& packet);
    void sendTo(Target& target, const log::Packet& packet);
    void heedRefusals(Target& target);
    void addRefusal(Target& target);
    void stopLoops();
    [[nodiscard]] bool isForwarded(const log::Packet& packet);
    [[nodiscard]] Verdict judge(log::SenderId sender) const;

    const log::PacketLog& m_log;
    const log::Clock& m_clock;
    CommandQueue m_commands{[this] { wake(); }};
    std::mutex m_wakeMutex;
    std::condition_variable m_wake;
    bool m_isWoken = false;    ///< guarded by m_wakeMutex
    bool m_isStopping = false; ///< only the thread reads it

    mutable std::mutex m_mutex; ///< guards m_targets and their problems against other threads
    std::vector<std::shared_ptr<Target>> m_targets;
    std::uint32_t m_nextId = 0;

    log::LogFollower m_follower;
    std::atomic<std::uint64_t> m_behind = 0;
    LoopWatch m_loops;
    std::vector<std::shared_ptr<Target>> m_going; ///< targets that are not stopped
    log::Stamp m_caughtUp{};                      ///< when it last had caught up
    std::unordered_map<log::SenderId, Verdict> m_verdicts;
    std::thread m_thread;
};

/// Why data sent to an address would come back through an input; nothing if it would not.
[[nodiscard]] std::optional<NetError> loopProblem(const Endpoint& target, const QHostAddress& address,
                                                  const std::vector<InputStatus>& inputs);

} // namespace posewire::net
