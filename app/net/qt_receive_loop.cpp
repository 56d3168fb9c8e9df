// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/listening.h"
#include "app/net/receive_loop.h"
#include "app/net/thread_events.h"

#include <optional>

namespace posewire::net {
namespace {

class QtReceiveLoop final : public ReceiveLoop {
public:
    explicit QtReceiveLoop(const ReceiveContext& context) : m_context(context) {}

    NetResult<void> add(const std::shared_ptr<Input>& input) override {
        m_events.begin();
        auto sockets = bindUdp(*input, m_context.options.bufferBytes);
        if (!sockets) {
            return tl::unexpected(sockets.error());
        }
        for (auto& socket : *sockets) {
            m_sockets.push_back({input, std::move(socket), std::nullopt});
        }
        return {};
    }

    void remove(InputId id) override {
        for (Socket& socket : m_sockets) {
            if (socket.input->id() == id) {
                drain(socket);
            }
        }
        std::erase_if(m_sockets, [id](const Socket& socket) { return socket.input->id() == id; });
    }

    void run() override {
        m_events.begin();
        while (!isStopping()) {
            m_context.commands.run();
            for (Socket& socket : m_sockets) {
                drain(socket);
            }
            if (!m_context.queue.isEmpty()) {
                m_context.queue.moveTo(m_context.log);
            }
            m_events.process(QEventLoop::WaitForMoreEvents);
        }
        for (Socket& socket : m_sockets) {
            drain(socket);
        }
        m_context.queue.moveTo(m_context.log);
        m_sockets.clear();
        m_events.end();
    }

    void wake() override { m_events.wake(); }

private:
    struct Last {
        QHostAddress address;
        quint16 port = 0;
        log::SenderId id{};
    };
    struct Socket {
        std::shared_ptr<Input> input;
        std::unique_ptr<QUdpSocket> socket;
        std::optional<Last> last;
    };

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
        log::Arrival arrival;
        arrival.stamp = m_context.clock.wall();
        arrival.sender = senderOf(socket, address, port);
        if (isSmall) {
            writer.commit(0, static_cast<std::size_t>(size), arrival);
        } else {
            writer.append(into.first(static_cast<std::size_t>(size)), arrival);
        }
        increase(socket.input->counters().datagrams, 1);
        increase(socket.input->counters().bytes, static_cast<std::uint64_t>(size));
        return true;
    }

    log::SenderId senderOf(Socket& socket, const QHostAddress& address, quint16 port) {
        if (!socket.last || socket.last->port != port || socket.last->address != address) {
            const log::SenderInfo info{textOf(address, port), log::Transport::Udp,
                                       socket.socket->localPort()};
            socket.last = Last{address, port, m_context.log.senders().intern(info)};
        }
        return socket.last->id;
    }

    ReceiveContext m_context;
    ThreadEvents m_events;
    std::vector<Socket> m_sockets;
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
