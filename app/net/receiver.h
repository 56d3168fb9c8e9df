// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/command_queue.h"
#include "app/net/input.h"
#include "app/net/net_error.h"
#include "app/net/packet_queue.h"
#include "core/log/clock.h"
#include "core/log/packet_log.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <vector>

namespace posewire::net {

class ReceiveLoop;
class TcpThread;

/// How datagrams are fetched. Both ways keep the same log, except that only Native knows kernel stamps and
/// kernel drops.
enum class ReceivePath : std::uint8_t {
    Native,   ///< the system's fastest: recvmmsg on Linux, elsewhere the same as Portable
    Portable, ///< Qt alone
};

struct ReceiverOptions {
    ReceivePath path = ReceivePath::Native;
    /// Of the kernel's buffer of each UDP socket: asked for. See InputStatus for what was granted.
    int bufferBytes = 4 << 20;
    /// The thread sleeps at most so long after each emptying of the sockets, and less where much arrives: the
    /// cheapest way to receive, at the price of this delay, since waking costs as much as receiving dozens of
    /// datagrams. Stamps are the kernel's and do not suffer.
    std::chrono::microseconds nap{6000};
};

/// Of all UDP inputs, also those that were removed. Written by the receiving thread, to be read by any.
struct ReceiveCounters {
    std::atomic<std::uint64_t> datagrams = 0;
    std::atomic<std::uint64_t> bytes = 0;
    std::atomic<std::uint64_t> kernelDropped = 0; ///< datagrams lost in this computer for want of buffer room
    /// In thousandths, the most since it was taken; -1 before it was looked at.
    std::atomic<std::int32_t> bufferFill = -1;
    std::atomic<std::int64_t> longestDelayNs =
        0; ///< the longest time the thread did not come to look at its sockets
};

/// Of all inputs since the receiver was made, also those that were removed.
struct ReceiveTotals {
    std::uint64_t datagrams = 0; ///< UDP and TCP; not what came by submit()
    std::uint64_t bytes = 0;
    std::uint64_t kernelDropped = 0;     ///< see ReceiveCounters
    std::uint64_t queueDropped = 0;      ///< refused by submit() for want of room
    std::int64_t receiveBufferBytes = 0; ///< the smallest that an open UDP input was granted, 0 without any
    std::int64_t longestDelayNs = 0;
};

/// The one thread that writes a PacketLog, from the beginning to the end of the program: takes datagrams from
/// UDP sockets straight into the log, and packets of other threads (TCP, files, a performer) through a queue.
/// Inputs come and go while it runs, and no other input loses anything by that. It is a std::thread (the
/// thread sanitizer sees nothing on a QThread), does nothing else, and so loses nothing when the window is
/// busy. The process needs a QCoreApplication, whose loop need not run. Every member may be called from any
/// thread but the receiver's own.
class Receiver {
public:
    /// While it lives, log.writer() and interning belong to its thread. `log` and `clock` must outlive it.
    Receiver(log::PacketLog& log, const log::Clock& clock, const ReceiverOptions& options = {});

    /// Stops and joins; the log has what had arrived in the sockets before.
    ~Receiver();
    Receiver(const Receiver&) = delete;
    Receiver& operator=(const Receiver&) = delete;

    /// Listens, or tells why not and what to do about it: a port in use with its holder where the system
    /// gives it away.
    NetResult<InputId> addUdp(const UdpInput& where);
    NetResult<InputId> addUdp(const Endpoint& endpoint) { return addUdp(UdpInput{endpoint, {}}); }

    /// MVN connects out to whoever listens; any number of senders may connect, up to kMostPeers.
    NetResult<InputId> addTcpListener(const Endpoint& endpoint);

    /// Connects, and connects again whenever that fails or the connection ends, after pauses that grow to
    /// five seconds. How it stands is in its status.
    InputId addTcpConnection(const Endpoint& endpoint);

    /// Takes what has arrived there already, and closes. False where there is no such input.
    bool remove(InputId id);

    /// In the order in which they were added.
    [[nodiscard]] std::vector<InputStatus> inputs() const;
    [[nodiscard]] ReceiveTotals totals() const;

    /// Processor time of the receiving thread in seconds; nothing where the system does not tell.
    [[nodiscard]] std::optional<double> cpuSeconds();

    /// Share of a UDP input's buffer that was full, the most that was seen since the last call, some ten
    /// times a second and after each delay; nothing where the system does not tell or no UDP input is open.
    [[nodiscard]] std::optional<double> takeBufferFill();

    /// Brings a packet into the log; `arrival.sender` need not be set. False where the queue is full: the
    /// packet is lost, and the log will tell so.
    bool submit(std::span<const std::byte> bytes, const log::SenderInfo& sender, const log::Arrival& arrival);

    /// The same, but waits for room. False only where the receiver ends.
    bool submitWaiting(std::span<const std::byte> bytes, const log::SenderInfo& sender,
                       const log::Arrival& arrival);

    /// Returns when everything submitted before is in the log.
    void flush();

    static constexpr std::size_t kMostPeers = 64; ///< of one TCP listener

private:
    std::shared_ptr<Input> makeInput(InputKind kind, const Endpoint& endpoint,
                                     std::vector<std::string> groups = {});
    void keep(const std::shared_ptr<Input>& input);
    TcpThread& tcp();
    void callAndWait(const CommandQueue::Command& command);

    log::PacketLog& m_log;
    const log::Clock& m_clock;
    PacketQueue m_queue;
    CommandQueue m_commands;
    ReceiveCounters m_counters;
    InputCounters m_tcpTotals; ///< of all TCP inputs there were
    std::unique_ptr<ReceiveLoop> m_loop;
    std::thread m_thread;

    mutable std::mutex m_mutex; ///< guards all that follows
    std::vector<std::shared_ptr<Input>> m_inputs;
    std::uint32_t m_nextId = 0;
    std::unique_ptr<TcpThread> m_tcp; ///< from the first TCP input on
};

} // namespace posewire::net
