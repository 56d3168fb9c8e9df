// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/allow_list.h"
#include "app/net/command_queue.h"
#include "app/net/endpoint.h"
#include "app/net/input.h"
#include "app/net/packet_queue.h"
#include "core/log/clock.h"
#include "core/log/kernel_counters.h"
#include "core/log/packet_log.h"
#include "core/log/time.h"

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

/// How datagrams are received. Both ways produce the same log, except that only Native has kernel stamps and
/// kernel drops.
enum class ReceivePath : std::uint8_t {
    Native,   ///< the system's fastest: recvmmsg on Linux, elsewhere the same as Portable
    Portable, ///< Qt alone
};

struct ReceiverOptions {
    ReceivePath path = ReceivePath::Native;
    /// Requested size of each UDP socket's kernel buffer. InputStatus has what was granted.
    int bufferBytes = 4 << 20;
    /// The thread sleeps at most this long after emptying the sockets, and less under load. That is the
    /// cheapest way to receive, since waking costs as much as receiving dozens of datagrams; the price is
    /// this delay. Stamps come from the kernel and are not affected.
    log::Duration nap = std::chrono::milliseconds(6);
};

/// Of the receiving thread, besides what it counts for each input. Written by it, read by any.
struct ReceiveCounters {
    /// Largest fill in thousandths since it was last read; -1 before the first look.
    std::atomic<std::int32_t> bufferFill = -1;
    std::atomic<log::Duration> longestDelay{}; ///< the longest time between two looks at the sockets
    /// What had come to the sockets until then is in the log; log::Moment::max() while it waits for more.
    std::atomic<log::Moment> readUntil = log::Moment::max();
};

/// Over all inputs since the receiver was created, removed ones included.
struct ReceiveTotals {
    std::uint64_t datagrams = 0; ///< UDP and TCP, without what submit() brought
    std::uint64_t bytes = 0;
    std::uint64_t kernelDropped = 0;     ///< see InputCounters
    std::int64_t receiveBufferBytes = 0; ///< the smallest granted to an open UDP input; 0 if none is open
    log::Duration longestDelay{};
    std::uint64_t refusedDatagrams = 0; ///< see InputCounters
    log::KernelCounters kernel{};       ///< looked at a few times a second; zeros if the system does not say
};

/// The one thread that writes a PacketLog for as long as the program runs. It receives UDP datagrams straight
/// into the log, and packets of other threads (TCP, files, a performer) through a queue. Inputs can be added
/// and removed while it runs without loss on the others. It is a std::thread (the thread sanitizer is blind
/// to QThread) and does nothing else, so a busy window loses no data. The process needs a QCoreApplication,
/// but its event loop need not run. Every member may be called from any thread except the receiver's own.
class Receiver {
public:
    /// During its lifetime log.writer() and interning belong to its thread. `log` and `clock` must outlive
    /// it.
    Receiver(log::PacketLog& log, const log::Clock& clock, const ReceiverOptions& options = {});

    /// Stops and joins, after logging what had already arrived in the sockets.
    ~Receiver();

    /// Listens, or says why not and what to do: for a port in use it names the holder where the system
    /// reveals it.
    NetResult<InputId> addUdp(const UdpInput& where);
    NetResult<InputId> addUdp(const Endpoint& endpoint) { return addUdp(UdpInput{endpoint, {}}); }

    /// MVN connects to a listener; up to kMostPeers senders may connect. Where more want in, one that has
    /// sent nothing for long gives way, after what it had sent has been read.
    NetResult<InputId> addTcpListener(const Endpoint& endpoint);

    /// Connects, and reconnects whenever that fails or the connection ends, with pauses that grow to five
    /// seconds. Its status has the current state.
    InputId addTcpConnection(const Endpoint& endpoint);

    /// Listens only to these from now on, on all inputs, those to come included; connections of others are
    /// closed. A connection that we make ourselves names its host already and is not asked.
    void listenTo(const AllowList& allowed);

    /// Replaces ReceiverOptions::nap. The thread naps for less if the buffers of the sockets are too small.
    void setNap(log::Duration nap) { m_nap.store(nap, std::memory_order_relaxed); }

    /// Reads what has already arrived there, then closes. False if there is no such input.
    bool remove(InputId id);

    /// In the order in which they were added.
    [[nodiscard]] std::vector<InputStatus> inputs() const;
    [[nodiscard]] ReceiveTotals totals() const;

    /// True if the receiving thread is late just now, since its computer is busy: what has come for a moment
    /// is still in the sockets, and nobody may be called silent. One that freezes for long is not late.
    [[nodiscard]] bool isHeldUp() const;

    /// CPU time of the receiving thread in seconds; empty if the system does not report it.
    [[nodiscard]] std::optional<double> cpuSeconds();

    /// Highest fill of a UDP input's buffer (0 to 1) since the last call, sampled about ten times a second
    /// and after each delay; empty if the system does not report it or no UDP input is open.
    [[nodiscard]] std::optional<double> takeBufferFill();

    /// Queues a packet for the log, once there is room; `arrival.sender` need not be set. False only when the
    /// receiver stops.
    bool submit(std::span<const std::byte> bytes, const log::SenderInfo& sender,
                const log::Arrival& arrival) {
        return m_queue.push(bytes, sender, arrival);
    }

    /// Returns once everything submitted before is in the log.
    void flush() {
        m_commands.call([&] { m_queue.moveTo(m_log); });
    }

    static constexpr std::size_t kMostPeers = 64; ///< of one TCP listener

private:
    std::shared_ptr<Input> makeInput(InputKind kind, const Endpoint& endpoint,
                                     std::vector<std::string> groups = {});
    void keep(const std::shared_ptr<Input>& input);
    TcpThread& tcp();

    log::PacketLog& m_log;
    const log::Clock& m_clock;
    std::atomic<log::Duration> m_nap;
    PacketQueue m_queue;
    CommandQueue m_commands;
    ReceiveCounters m_counters;
    std::unique_ptr<ReceiveLoop> m_loop;
    std::thread m_thread;

    mutable std::mutex m_mutex; ///< guards the members below
    std::vector<std::shared_ptr<Input>> m_inputs;
    ReceiveTotals m_past; ///< of removed inputs
    const std::optional<log::KernelCounters> m_kernelBefore;
    mutable log::KernelCounters m_kernel; ///< since then
    mutable log::Moment m_kernelRead{};
    AllowList m_allowed;
    std::uint32_t m_nextId = 0;
    std::unique_ptr<TcpThread> m_tcp; ///< from the first TCP input on
};

} // namespace posewire::net
