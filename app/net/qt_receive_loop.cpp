// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/qt_receive_loop.h"

#include "app/net/udp_binding.h"

#include <QEventLoop>
#include <QHostAddress>

#include <algorithm>
#include <mutex>
#include <optional>

namespace posewire::net {

namespace {

/// The text of an address as the operator writes it: IPv4 as such also where an IPv6 socket received it.
std::string addressText(const QHostAddress& address) {
    bool isIpv4 = false;
    const QHostAddress ipv4(address.toIPv4Address(&isIpv4));
    return (isIpv4 ? ipv4 : address).toString().toStdString();
}

class QtReceiveLoop final : public ReceiveLoop {
public:
    explicit QtReceiveLoop(const ReceiveContext& context) : m_context(context) {}

    NetResult<std::vector<Endpoint>> open(const ReceiveOptions& options) override;
    void run() override;
    void wake() override;

private:
    struct Last {
        QHostAddress address;
        quint16 port = 0;
        log::SourceId id{};
    };
    struct Socket {
        std::unique_ptr<QUdpSocket> socket;
        std::optional<Last> last;
    };

    void drain(Socket& socket);
    bool takeOne(Socket& socket);
    log::SourceId sourceOf(Socket& socket, const QHostAddress& address, quint16 port);
    void close();

    ReceiveContext m_context;
    std::mutex m_mutex; ///< guards m_eventLoop against a wake() before or after its life
    std::unique_ptr<QEventLoop> m_eventLoop;
    std::vector<Socket> m_sockets;
};

NetResult<std::vector<Endpoint>> QtReceiveLoop::open(const ReceiveOptions& options) {
    {
        const std::lock_guard lock(m_mutex);
        m_eventLoop = std::make_unique<QEventLoop>(); // first: sockets need the thread's event dispatcher
    }
    std::vector<Endpoint> endpoints;
    std::int64_t smallest = INT64_MAX;
    for (const Endpoint& endpoint : options.endpoints) {
        auto socket = bindUdp(endpoint, options.bufferBytes);
        if (!socket) {
            close();
            return tl::unexpected(socket.error());
        }
        smallest = std::min<std::int64_t>(smallest, receiveBufferBytes(**socket));
        endpoints.push_back({endpoint.host, (*socket)->localPort()});
        m_sockets.push_back({std::move(*socket), std::nullopt});
    }
    m_context.counters.receiveBufferBytes = smallest == INT64_MAX ? 0 : smallest;
    return endpoints;
}

void QtReceiveLoop::run() {
    while (!isStopping()) {
        m_eventLoop->processEvents(QEventLoop::WaitForMoreEvents);
        for (Socket& socket : m_sockets) {
            drain(socket);
        }
        if (!m_context.queue.isEmpty()) {
            m_context.queue.moveTo(m_context.log);
        }
    }
    for (Socket& socket : m_sockets) {
        drain(socket);
    }
    m_context.queue.moveTo(m_context.log);
    close();
}

void QtReceiveLoop::wake() {
    const std::lock_guard lock(m_mutex);
    if (m_eventLoop) {
        m_eventLoop->wakeUp();
    }
}

/// What is there now, and not for ever what goes on arriving: other sockets wait, too.
void QtReceiveLoop::drain(Socket& socket) {
    constexpr int kMost = 1000;
    int count = 0;
    while (count < kMost && takeOne(socket)) {
        ++count;
    }
    m_context.log.writer().publish();
}

bool QtReceiveLoop::takeOne(Socket& socket) {
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
    arrival.stampNs = m_context.clock.wallNs();
    arrival.source = sourceOf(socket, address, port);
    if (isSmall) {
        writer.commit(0, static_cast<std::size_t>(size), arrival);
    } else {
        writer.append(into.first(static_cast<std::size_t>(size)), arrival);
    }
    add<std::uint64_t>(m_context.counters.datagrams, 1);
    add<std::uint64_t>(m_context.counters.bytes, static_cast<std::uint64_t>(size));
    return true;
}

log::SourceId QtReceiveLoop::sourceOf(Socket& socket, const QHostAddress& address, quint16 port) {
    if (!socket.last || socket.last->port != port || socket.last->address != address) {
        const log::SourceInfo info{textOf(Endpoint{addressText(address), port}), log::Transport::Udp,
                                   socket.socket->localPort()};
        socket.last = Last{address, port, m_context.log.sources().intern(info)};
    }
    return socket.last->id;
}

void QtReceiveLoop::close() {
    m_sockets.clear();
    const std::lock_guard lock(m_mutex);
    m_eventLoop.reset();
}

} // namespace

std::unique_ptr<ReceiveLoop> makeQtReceiveLoop(const ReceiveContext& context) {
    return std::make_unique<QtReceiveLoop>(context);
}

} // namespace posewire::net
