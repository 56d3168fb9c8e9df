// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/listening.h"
#include "app/net/receive_loop.h"
#include "app/net/tcp_thread.h"

#include <QNetworkInterface>
#include <QTimer>

#include <memory>
#include <optional>
#include <utility>

namespace posewire::net {
namespace {

class QtReceiveLoop final : public ReceiveLoop {
public:
    explicit QtReceiveLoop(const ReceiveContext& context)
        : m_context(context), m_clock(context.log.timeline(), context.clock) {}

    NetResult<void> add(const std::shared_ptr<Input>& input) override {
        m_events.begin();
        auto sockets = bindUdp(*input, m_context.options.bufferBytes);
        if (!sockets) {
            return tl::unexpected(sockets.error());
        }
        Joined joined{input, {}};
        for (auto& [socket, groups] : *sockets) {
            for (const QHostAddress& group : groups) {
                joined.groups.add(
                    group, [socket = socket.get()](const auto& address, const auto& interface, bool joins) {
                        const bool isDone = joins ? socket->joinMulticastGroup(address, interface)
                                                  : socket->leaveMulticastGroup(address, interface);
                        return isDone ? std::string() : socket->errorString().toStdString();
                    });
            }
            const bool isReopened = wasClosed(socket->localPort());
            m_sockets.push_back({input, std::move(socket), std::nullopt, isReopened});
        }
        listenOnOwn(joined.groups, *input);
        if (!joined.groups.isEmpty()) {
            m_joined.push_back(std::move(joined));
            followInterfaces();
        }
        return {};
    }

    void listenTo(const AllowList& allowed) override {
        m_allowed = allowed;
        for (Socket& socket : m_sockets) {
            socket.last.reset();
        }
    }

    void remove(InputId id) override {
        for (Socket& socket : m_sockets) {
            if (socket.input->id() == id) {
                drain(socket);
                noteClosed(socket.socket->localPort());
            }
        }
        std::erase_if(m_joined, [id](const Joined& joined) { return joined.input->id() == id; });
        std::erase_if(m_sockets, [id](const Socket& socket) { return socket.input->id() == id; });
    }

    void run() override {
        m_events.begin();
        while (!isStopping()) {
            m_context.commands.run();
            m_context.counters.readUntil.store(m_context.clock.monotonic(), std::memory_order_release);
            m_clock.look();
            m_clock.settle(); // what comes now gets its stamps here
            for (Socket& socket : m_sockets) {
                drain(socket);
            }
            if (!m_context.queue.isEmpty()) {
                m_context.queue.moveTo(m_context.log);
            }
            if (!m_joined.empty() && m_context.clock.monotonic() - m_followed >= kInterfacePause) {
                followInterfaces();
            }
            m_context.counters.readUntil.store(log::Moment::max(), std::memory_order_release);
            m_events.process(QEventLoop::WaitForMoreEvents);
        }
        for (Socket& socket : m_sockets) {
            drain(socket);
        }
        m_context.queue.moveTo(m_context.log);
        m_joined.clear();
        m_sockets.clear();
        m_interfaceTimer.reset();
        m_events.end();
    }

    void wake() override { m_events.wake(); }

private:
    struct Last {
        QHostAddress address;
        quint16 port = 0;
        std::optional<log::SenderId> id{}; ///< nothing for one who is not listened to
    };
    struct Joined {
        std::shared_ptr<Input> input;
        GroupMemberships groups;
    };
    struct Socket {
        std::shared_ptr<Input> input;
        std::unique_ptr<QUdpSocket> socket;
        std::optional<Last> last;
        bool isReopened = false; ///< and nothing has come yet
    };

    void followInterfaces() {
        if (!m_interfaceTimer) {
            m_interfaceTimer = std::make_unique<QTimer>(); // ends the wait for events
            m_interfaceTimer->start(std::chrono::duration_cast<std::chrono::milliseconds>(kInterfacePause));
        }
        const auto interfaces = QNetworkInterface::allInterfaces();
        for (Joined& joined : m_joined) {
            joined.groups.follow(interfaces);
            tellGroups(*joined.input, joined.groups);
        }
        m_followed = m_context.clock.monotonic();
    }

    /// Only what has arrived by now: other sockets are waiting.
    void drain(Socket& socket) {
        constexpr int kMost = 1000;
        int count = 0;
        while (count < kMost && takeOne(socket)) {
            ++count;
        }
        m_context.log.writer().publish();
    }

    bool takeOne(Socket& socket) {
        log::LogWriter& writer = m_context.log.writer();
        const log::LogWriter::Lane lane = writer.lanes().front();
        const qint64 expected = socket.socket->pendingDatagramSize();
        if (expected < 0) {
            return false;
        }
        const bool isSmall = static_cast<std::size_t>(expected) <= lane.bytes.size();
        const std::span<std::byte> into = isSmall ? lane.bytes : lane.spill;
        QHostAddress address;
        quint16 port = 0;
        const qint64 size = socket.socket->readDatagram(reinterpret_cast<char*>(into.data()),
                                                        static_cast<qint64>(into.size()), &address, &port);
        if (size < 0) {
            return false;
        }
        const auto sender = senderOf(socket, address, port);
        if (!sender) {
            increase(socket.input->counters().refusedDatagrams, 1);
            return true;
        }
        log::Arrival arrival;
        arrival.stamp = m_context.log.timeline().now(m_context.clock);
        arrival.sender = *sender;
        arrival.flags.dropsUncounted = true;
        arrival.flags.afterClosed = std::exchange(socket.isReopened, false);
        if (isSmall) {
            writer.commit(0, static_cast<std::size_t>(size), arrival);
        } else {
            writer.append(into.first(static_cast<std::size_t>(size)), arrival);
        }
        increase(socket.input->counters().datagrams, 1);
        increase(socket.input->counters().bytes, static_cast<std::uint64_t>(size));
        return true;
    }

    std::optional<log::SenderId> senderOf(Socket& socket, const QHostAddress& address, quint16 port) {
        if (!socket.last || socket.last->port != port || socket.last->address != address) {
            socket.last = Last{address, port, std::nullopt};
            if (m_allowed.allows(address)) {
                socket.last->id = m_context.log.senders().intern(
                    {textOf(address, port), log::Transport::Udp, socket.socket->localPort()});
            }
        }
        return socket.last->id;
    }

    ReceiveContext m_context;
    log::ClockWatch m_clock;
    ThreadEvents m_events;
    AllowList m_allowed;
    std::vector<Socket> m_sockets;
    std::vector<Joined> m_joined;
    std::unique_ptr<QTimer> m_interfaceTimer; ///< from the first group on
    log::Moment m_followed{};                 ///< when interfaces were last asked for
};

} // namespace

std::unique_ptr<ReceiveLoop> makeReceiveLoop(const ReceiveContext& context) {
#ifdef __linux__
    if (context.options.path == ReceivePath::Native) {
        return makeRecvmmsgLoop(context);
    }
#endif
    return std::make_unique<QtReceiveLoop>(context);
}

} // namespace posewire::net
