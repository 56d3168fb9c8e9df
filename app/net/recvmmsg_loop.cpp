// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/kernel_socket.h"
#include "app/net/listening.h"
#include "app/net/receive_loop.h"

#include <QEventLoop>
#include <QNetworkInterface>

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <optional>
#include <thread>

namespace posewire::net {
namespace {

/// After this many naps without a datagram the loop blocks until one arrives, so an idle monitor uses no CPU
/// time.
constexpr int kNapsUntilIdle = 200;
/// Below this, naps cost more than they save.
constexpr log::Duration kShortestNap = std::chrono::microseconds(500);
/// What the kernel charges a socket's buffer for a datagram of usual size (measured for 760 bytes).
constexpr std::size_t kBufferPerDatagram = 2304;
/// Batches read from one socket before the others get a turn.
constexpr int kBatchesPerTurn = 256;
/// Rounds between two reads of the kernel's drop counters: about ten reads a second.
constexpr int kRoundsPerDropCheck = 16;

struct Socket {
    std::shared_ptr<Input> input;
    log::Descriptor descriptor;
    SenderCache senders;
    log::Stamp last{};              ///< the newest of its datagrams
    std::uint32_t dropsInLog = 0;   ///< how many of the kernel's drops the log has
    std::uint32_t dropsCounted = 0; ///< how many of them the counters have
    log::SenderId lastSender{};
    bool hasSender = false;
    bool isEmpty = true; ///< at the last look
    std::uint16_t localPort = 0;
    bool isReopened = false; ///< and nothing has come yet
    MessageBatch batch{};
};

/// An input with multicast groups.
struct JoinedInput {
    std::shared_ptr<Input> input;
    GroupMemberships groups;
};

class RecvmmsgLoop final : public ReceiveLoop {
public:
    explicit RecvmmsgLoop(const ReceiveContext& context)
        : m_context(context),
          m_clock(context.log.timeline(), context.clock),
          m_wake(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
          m_nap(context.options.nap) {}

    NetResult<void> add(const std::shared_ptr<Input>& input) override {
        const QEventLoop dispatcher; // Qt's sockets need one in their thread, if only to open
        const auto bound = bindUdp(*input, m_context.options.bufferBytes);
        if (!bound) {
            return tl::unexpected(bound.error());
        }
        JoinedInput joined{input, {}};
        for (const auto& [socket, groups] : *bound) {
            // A descriptor of our own, without Qt's notifiers; Qt closes its own at the end of this turn.
            log::Descriptor descriptor(
                ::fcntl(static_cast<int>(socket->socketDescriptor()), F_DUPFD_CLOEXEC, 0));
            prepare(descriptor.number());
            for (const QHostAddress& group : groups) {
                joined.groups.add(group, [fd = descriptor.number()](const auto& address,
                                                                    const auto& interface, bool joins) {
                    return changeMembership(fd, address, interface.index(), joins);
                });
            }
            m_sockets.push_back(std::unique_ptr<Socket>(
                new Socket{.input = input,
                           .descriptor = std::move(descriptor),
                           .senders = SenderCache(m_context.log.senders(), socket->localPort(), m_allowed),
                           .localPort = socket->localPort(),
                           .isReopened = wasClosed(socket->localPort())}));
        }
        listenOnOwn(joined.groups, *input);
        if (!joined.groups.isEmpty()) {
            m_joined.push_back(std::move(joined));
            followInterfaces();
        }
        measureBuffers();
        return {};
    }

    void listenTo(const AllowList& allowed) override {
        m_allowed = allowed;
        for (const auto& socket : m_sockets) {
            socket->senders.forget();
        }
    }

    void remove(InputId id) override {
        for (const auto& socket : m_sockets) {
            if (socket->input->id() == id) {
                drainToTheEnd(*socket);
                noteClosed(socket->localPort);
            }
        }
        std::erase_if(m_joined, [id](const JoinedInput& joined) { return joined.input->id() == id; });
        std::erase_if(m_sockets, [id](const auto& socket) { return socket->input->id() == id; });
        measureBuffers();
    }

    void run() override {
        m_looked = m_context.clock.monotonic();
        while (!isStopping()) {
            m_context.commands.run();
            rest(drainAll());
        }
        for (const auto& socket : m_sockets) {
            drainToTheEnd(*socket);
        }
        m_context.queue.moveTo(m_context.log);
    }

    void wake() override {
        const std::uint64_t one = 1;
        [[maybe_unused]] const auto written =
            ::write(m_wake.number(), &one, sizeof one); // a full pipe wakes the loop just as well
    }

private:
    std::size_t drainAll() {
        std::size_t count = 0;
        if (m_roundsSinceDropCheck == 0 || m_isDelayed) {
            measureFill();
        }
        for (const auto& socket : m_sockets) {
            count += drain(*socket);
        }
        m_clock.settle();
        m_clock.look();
        if (!m_context.queue.isEmpty()) {
            count += m_context.queue.moveTo(m_context.log);
        }
        if (++m_roundsSinceDropCheck >= kRoundsPerDropCheck) {
            checkAllDrops();
        }
        return count;
    }

    std::size_t drain(Socket& socket) {
        log::LogWriter& writer = m_context.log.writer();
        std::size_t total = 0;
        for (int turn = 0; turn < kBatchesPerTurn; ++turn) {
            const auto lanes = writer.lanes();
            const std::size_t count = socket.batch.receive(socket.descriptor.number(), lanes);
            const log::Stamp now = m_clock.look();
            std::size_t bytes = 0;
            std::size_t heard = 0;
            for (std::size_t i = 0; i < count; ++i) {
                if (const auto sender = socket.senders.idOf(socket.batch.sender(i))) {
                    bytes += commit(socket, i, *sender, now);
                    ++heard;
                }
            }
            total += count;
            if (count > 0) {
                writer.publish();
                increase(socket.input->counters().datagrams, heard);
                increase(socket.input->counters().bytes, bytes);
                increase(socket.input->counters().refusedDatagrams, count - heard);
            }
            if (count < lanes.size()) {
                break;
            }
        }
        socket.isEmpty = total == 0;
        return total;
    }

    /// Up to a full buffer and its drops, since there is no later chance; bounded, since data may keep
    /// arriving.
    void drainToTheEnd(Socket& socket) {
        constexpr int kMostTurns = 16;
        for (int turn = 0; turn < kMostTurns && drain(socket) != 0; ++turn) {
        }
        socket.isEmpty = true;
        checkDrops(socket);
    }

    /// Bytes of the datagram.
    std::size_t commit(Socket& socket, std::size_t index, log::SenderId sender, log::Stamp now) {
        const Received received = socket.batch.received(index);
        log::Arrival arrival;
        arrival.sender = sender;
        socket.lastSender = sender;
        socket.hasSender = true;
        arrival.flags.truncated = received.isTruncated;
        arrival.flags.stampedByKernel = received.time != log::WallTime();
        arrival.flags.afterClosed = std::exchange(socket.isReopened, false);
        // Datagrams of one socket are in order, but the clocks of two CPUs of a virtual machine may not
        // agree.
        const log::Stamp stamp = arrival.flags.stampedByKernel ? m_clock.stampOf(received.time) : now;
        arrival.stamp = socket.last = std::max(stamp, std::min(socket.last, now));
        // 0 is none. A packet under way may carry a smaller count than a record made meanwhile.
        if (received.drops != 0 && static_cast<std::int32_t>(received.drops - socket.dropsInLog) > 0) {
            arrival.kernelDropsBefore = received.drops - socket.dropsInLog;
            socket.dropsInLog = received.drops;
            countDrops(socket, received.drops);
        }
        m_context.log.writer().commit(index, received.size, arrival);
        return received.size;
    }

    /// `drops` is the kernel's count so far; a packet may carry less than the counter that was read before
    /// it.
    void countDrops(Socket& socket, std::uint32_t drops) {
        const auto more = static_cast<std::int32_t>(drops - socket.dropsCounted);
        if (more > 0) {
            socket.dropsCounted = drops;
            increase(socket.input->counters().kernelDropped, static_cast<std::uint64_t>(more));
        }
    }

    /// Drops that no packet reported become a record of their own.
    void recordDrops(Socket& socket, std::uint32_t drops) {
        const auto more = static_cast<std::int32_t>(drops - socket.dropsInLog);
        if (more <= 0 || !socket.hasSender) { // a full buffer holds packets, so a sender is known by then
            return;
        }
        log::Arrival arrival;
        arrival.stamp = m_clock.look();
        arrival.sender = socket.lastSender;
        arrival.kernelDropsBefore = static_cast<std::uint32_t>(more);
        arrival.flags.skipped = true;
        arrival.flags.isDropRecord = true;
        socket.dropsInLog = drops;
        m_context.log.writer().append({}, arrival);
        m_context.log.writer().publish();
    }

    /// A packet reports loss only once the next one arrives; the socket knows at once.
    void checkDrops(Socket& socket) {
        if (const auto memory = memoryOf(socket.descriptor.number())) {
            countDrops(socket, memory->drops);
            if (socket.isEmpty) {
                recordDrops(socket, memory->drops);
            }
        }
    }

    void checkAllDrops() {
        m_roundsSinceDropCheck = 0;
        for (const auto& socket : m_sockets) {
            checkDrops(*socket);
        }
        if (!m_joined.empty() && haveInterfacesChanged()) {
            followInterfaces();
        }
    }

    bool haveInterfacesChanged() {
        return m_watch->descriptor() >= 0 ? m_watch->hasChanged()
                                          : m_context.clock.monotonic() - m_followed >= kInterfacePause;
    }

    void followInterfaces() {
        if (!m_watch) {
            m_watch.emplace(); // before the interfaces are asked for, so that no change is missed
        }
        const auto interfaces = QNetworkInterface::allInterfaces();
        for (JoinedInput& joined : m_joined) {
            joined.groups.follow(interfaces);
            tellGroups(*joined.input, joined.groups);
        }
        m_followed = m_context.clock.monotonic();
    }

    void measureBuffers() {
        m_smallestBuffer = SIZE_MAX;
        for (const auto& socket : m_sockets) {
            const auto granted = socket->input->counters().receiveBufferBytes.load(std::memory_order_relaxed);
            m_smallestBuffer = std::min(m_smallestBuffer, static_cast<std::size_t>(granted));
        }
    }

    /// Before the sockets are emptied; the fullest one counts.
    void measureFill() {
        m_isDelayed = false;
        for (const auto& socket : m_sockets) {
            if (const auto memory = memoryOf(socket->descriptor.number());
                memory && memory->bufferBytes != 0) {
                const auto fill =
                    static_cast<std::int32_t>(std::uint64_t{memory->usedBytes} * 1000 / memory->bufferBytes);
                std::atomic<std::int32_t>& most = m_context.counters.bufferFill;
                most.store(std::max(most.load(std::memory_order_relaxed), fill), std::memory_order_relaxed);
            }
        }
    }

    void rest(std::size_t received) {
        m_context.counters.readUntil.store(m_looked, std::memory_order_release);
        m_idleNaps = received != 0 ? 0 : m_idleNaps + 1;
        adaptNap(received);
        if (m_idleNaps > kNapsUntilIdle) {
            checkAllDrops();
            waitForSomething();
            m_looked = m_context.clock.monotonic();
            return;
        }
        std::this_thread::sleep_for(m_nap);
        const log::Moment now = m_context.clock.monotonic();
        const log::Duration delay = now - std::exchange(m_looked, now);
        m_isDelayed = delay > 2 * longestNap();
        if (delay > m_context.counters.longestDelay.load(std::memory_order_relaxed)) {
            m_context.counters.longestDelay.store(delay, std::memory_order_relaxed);
        }
    }

    /// Naps up to the limit, but never long enough for the current rate to fill more than an eighth of the
    /// buffer.
    void adaptNap(std::size_t received) {
        if (received * kBufferPerDatagram > m_smallestBuffer / 8) {
            m_nap = std::max(m_nap / 2, std::min(kShortestNap, longestNap()));
        } else {
            m_nap = std::min(m_nap + m_nap / 4, longestNap());
        }
    }

    /// Returns the nap that was asked for, cut to what keeps the smallest buffer half empty in a sudden
    /// flood, but never below the usual nap for that reason.
    log::Duration longestNap() const {
        constexpr log::Duration kFloodPause = std::chrono::microseconds(100); // between two datagrams
        constexpr std::size_t kMost = 1'000;
        const std::size_t room = std::min(m_smallestBuffer / (2 * kBufferPerDatagram), kMost);
        return std::min(m_context.nap.load(std::memory_order_relaxed),
                        std::max(m_context.options.nap, static_cast<int>(room) * kFloodPause));
    }

    void waitForSomething() {
        std::vector<pollfd> watched{{m_wake.number(), POLLIN, 0}};
        for (const auto& socket : m_sockets) {
            watched.push_back({socket->descriptor.number(), POLLIN, 0});
        }
        int longestMs = -1;
        if (!m_joined.empty()) {
            watched.push_back({m_watch->descriptor(), POLLIN, 0}); // -1 is passed over
            longestMs = m_watch->descriptor() >= 0
                            ? -1
                            : static_cast<int>(kInterfacePause / std::chrono::milliseconds(1));
        }
        m_context.counters.readUntil.store(log::Moment::max(), std::memory_order_release);
        ::poll(watched.data(), watched.size(), longestMs);
        std::uint64_t wakes = 0;
        [[maybe_unused]] const auto read = ::read(m_wake.number(), &wakes, sizeof wakes);
    }

    ReceiveContext m_context;
    log::ClockWatch m_clock;
    log::Descriptor m_wake;
    log::Duration m_nap;
    std::size_t m_smallestBuffer = SIZE_MAX; ///< of the sockets, in bytes
    AllowList m_allowed;                     ///< the senders' caches point to it
    std::vector<std::unique_ptr<Socket>> m_sockets;
    std::vector<JoinedInput> m_joined;
    std::optional<InterfaceWatch> m_watch; ///< from the first group or address of its own on
    log::Moment m_followed{};              ///< when interfaces were last asked for
    int m_idleNaps = 0;
    bool m_isDelayed = false; ///< the sockets waited longer than usual
    int m_roundsSinceDropCheck = 0;
    log::Moment m_looked{}; ///< when the sockets were last looked at
};

} // namespace

std::unique_ptr<ReceiveLoop> makeRecvmmsgLoop(const ReceiveContext& context) {
    return std::make_unique<RecvmmsgLoop>(context);
}

} // namespace posewire::net
