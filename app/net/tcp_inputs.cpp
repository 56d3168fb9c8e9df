// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/listening.h"
#include "app/net/receiver.h"
#include "app/net/tcp_thread.h"
#include "core/log/tcp_framer.h"

#include <QHostAddress>
#include <QNetworkProxy>
#include <QTcpServer>
#include <QTcpSocket>

#include <algorithm>
#include <array>
#include <cstdio>

namespace posewire::net {
namespace {

constexpr log::Duration kPublish = std::chrono::milliseconds(100);
constexpr log::Duration kFirstPause = std::chrono::milliseconds(250);
constexpr log::Duration kLongestPause = std::chrono::seconds(5);
/// An attempt without an answer by then has failed.
constexpr log::Duration kPatience = std::chrono::seconds(5);
/// Of a connection, besides what its framer keeps.
constexpr qint64 kReadBuffer = qint64{128} << 10;

std::string secondsText(log::Duration duration) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "%.3g s", log::secondsOf(duration));
    return text.data();
}

/// One TCP connection: splits its bytes into datagrams and passes them on.
class TcpPeer {
public:
    /// `socket` is connected. `localPort` is recorded as the port that the sender's data arrived at.
    TcpPeer(const TcpContext& context, std::shared_ptr<Input> input, std::unique_ptr<QTcpSocket> socket,
            std::uint16_t localPort)
        : m_context(context),
          m_input(std::move(input)),
          m_socket(std::move(socket)),
          m_sender{textOf(m_socket->peerAddress(), m_socket->peerPort()), log::Transport::Tcp, localPort},
          m_status{m_sender.address, context.clock.wall()} {
        m_socket->setReadBufferSize(kReadBuffer);
        m_socket->setSocketOption(QAbstractSocket::KeepAliveOption, 1);
    }

    /// Reads a bounded amount, so that others get a turn; true if there is more. Blocks while the queue is
    /// full.
    bool read() {
        std::array<char, std::size_t{64} << 10> buffer; // uninitialized: most of it is never used
        const qint64 size = m_socket->read(buffer.data(), static_cast<qint64>(buffer.size()));
        if (size <= 0) {
            return false;
        }
        const auto bytes = static_cast<std::uint64_t>(size);
        m_stamp = m_context.clock.wall();
        m_status.bytes += bytes;
        increase(m_input->counters().bytes, bytes);
        m_framer.push(std::as_bytes(std::span(buffer).first(static_cast<std::size_t>(size))),
                      [this](const log::TcpFramer::Piece& piece) { take(piece); });
        return m_socket->bytesAvailable() > 0;
    }

    /// The other end closed or was lost, and everything it sent has been read.
    [[nodiscard]] bool hasEnded() const {
        return m_socket->state() == QAbstractSocket::UnconnectedState && m_socket->bytesAvailable() == 0;
    }

    /// Reads what has arrived, without waiting for more. For closing from this side: an unfinished datagram
    /// is then nobody's fault and is not reported.
    void drain() {
        while (read()) {
        }
    }

    /// Passes on the rest of a connection that ended inside a datagram. After hasEnded().
    void finish() {
        m_stamp = m_context.clock.wall();
        m_framer.finish([this](const log::TcpFramer::Piece& piece) { take(piece); });
    }

    [[nodiscard]] const Peer& status() const { return m_status; }

private:
    void take(const log::TcpFramer::Piece& piece) {
        log::Arrival arrival;
        arrival.stamp = m_stamp;
        arrival.flags.skipped = piece.kind == log::TcpFramer::Kind::Skipped;
        if (arrival.flags.skipped) {
            m_status.skippedBytes += piece.bytes.size();
            increase(m_input->counters().skippedBytes, piece.bytes.size());
        } else {
            ++m_status.datagrams;
            increase(m_input->counters().datagrams, 1);
        }
        m_context.queue.push(piece.bytes, m_sender, arrival);
    }

    const TcpContext& m_context;
    std::shared_ptr<Input> m_input;
    std::unique_ptr<QTcpSocket> m_socket;
    log::SenderInfo m_sender;
    log::TcpFramer m_framer;
    log::Stamp m_stamp{}; ///< of the bytes being read
    Peer m_status;
};

class TcpListener final : public TcpInput {
public:
    TcpListener(const TcpContext& context, std::shared_ptr<Input> input)
        : TcpInput(context, std::move(input)) {
        m_server.setProxy(QNetworkProxy::NoProxy);
    }

    NetResult<void> listen() {
        const Endpoint endpoint = m_input->status().endpoint;
        const auto address = listenAddress(endpoint.host);
        if (!address) {
            return tl::unexpected(address.error());
        }
        if (!m_server.listen(*address, endpoint.port)) {
            return tl::unexpected(
                listenError("TCP", endpoint, m_server.serverError(), m_server.errorString()));
        }
        m_input->setPort(m_server.serverPort());
        publish();
        return {};
    }

    bool turn(log::Moment now) override {
        bool hasChanged = accept();
        bool hasMore = false;
        bool hasRead = false;
        for (const auto& peer : m_peers) {
            const std::uint64_t before = peer->status().bytes;
            hasMore |= peer->read();
            hasRead |= peer->status().bytes != before;
            if (peer->hasEnded()) {
                peer->finish();
            }
        }
        hasChanged |= std::erase_if(m_peers, [](const auto& peer) { return peer->hasEnded(); }) != 0;
        if (hasChanged || (m_publish && now >= *m_publish)) {
            publish();
        } else if (hasRead && !m_publish) {
            m_publish = now + kPublish;
        }
        return hasMore;
    }

    [[nodiscard]] std::optional<log::Moment> due() const override { return m_publish; }

    void drain() override {
        for (const auto& peer : m_peers) {
            peer->drain();
        }
    }

private:
    bool accept() {
        bool hasChanged = false;
        while (m_server.hasPendingConnections()) {
            std::unique_ptr<QTcpSocket> socket(m_server.nextPendingConnection());
            socket->setParent(nullptr);
            if (m_peers.size() < Receiver::kMostPeers) {
                m_peers.push_back(
                    std::make_unique<TcpPeer>(m_context, m_input, std::move(socket), m_server.serverPort()));
            } else {
                socket->abort();
                ++m_refused;
            }
            hasChanged = true;
        }
        return hasChanged;
    }

    void publish() {
        m_publish.reset();
        std::vector<Peer> peers;
        for (const auto& peer : m_peers) {
            peers.push_back(peer->status());
        }
        m_input->setState(InputState::Listening, peers.empty() ? "listening; nobody has connected"
                                                               : std::to_string(peers.size()) + " connected");
        m_input->setPeers(std::move(peers), m_refused);
    }

    QTcpServer m_server;
    std::vector<std::unique_ptr<TcpPeer>> m_peers;
    std::uint64_t m_refused = 0;
    std::optional<log::Moment> m_publish; ///< when to publish the peers' counters next
};

class TcpDialer final : public TcpInput {
public:
    TcpDialer(const TcpContext& context, std::shared_ptr<Input> input)
        : TcpInput(context, std::move(input)), m_endpoint(m_input->status().endpoint) {}

    bool turn(log::Moment now) override {
        if (!m_socket && !m_peer && now >= m_next) {
            begin(now);
        }
        if (m_socket) {
            await(now);
        }
        if (!m_peer) {
            return false;
        }
        const bool hasMore = m_peer->read();
        if (m_peer->status().datagrams != 0) {
            m_pause = kFirstPause;
        }
        if (m_peer->hasEnded()) {
            m_peer->finish();
            m_peer.reset();
            pause(now, "the connection to " + textOf(m_endpoint) + " ended");
        } else if (!m_publish) {
            m_publish = now + kPublish;
        } else if (now >= *m_publish) {
            publish();
        }
        return hasMore;
    }

    [[nodiscard]] std::optional<log::Moment> due() const override {
        if (m_peer) {
            return m_publish;
        }
        return m_socket ? m_begun + kPatience : m_next;
    }

    void drain() override {
        if (m_peer) {
            m_peer->drain();
        }
    }

private:
    void begin(log::Moment now) {
        m_begun = now;
        m_socket = std::make_unique<QTcpSocket>();
        m_socket->setProxy(QNetworkProxy::NoProxy);
        m_socket->setReadBufferSize(kReadBuffer);
        m_socket->connectToHost(m_endpoint.host.empty() ? QStringLiteral("127.0.0.1")
                                                        : QString::fromStdString(m_endpoint.host),
                                m_endpoint.port);
        m_input->setState(InputState::Connecting, "connecting to " + textOf(m_endpoint));
    }

    void await(log::Moment now) {
        const auto state = m_socket->state();
        if (state == QAbstractSocket::ConnectedState || m_socket->bytesAvailable() > 0) {
            // 0: the local port changes with each connection and would make it a new sender.
            m_peer = std::make_unique<TcpPeer>(m_context, m_input, std::move(m_socket), std::uint16_t{0});
            publish();
        } else if (state == QAbstractSocket::UnconnectedState) {
            pause(now, textOf(m_endpoint) + " cannot be reached: " + m_socket->errorString().toStdString());
        } else if (now - m_begun >= kPatience) {
            pause(now, textOf(m_endpoint) + " does not answer");
        }
    }

    void pause(log::Moment now, const std::string& why) {
        m_socket.reset();
        m_publish.reset();
        m_next = now + m_pause;
        m_input->setPeers({}, 0);
        m_input->setState(InputState::Retrying, why + "; trying again in " + secondsText(m_pause));
        m_pause = std::min(2 * m_pause, kLongestPause);
    }

    void publish() {
        m_publish.reset();
        m_input->setState(InputState::Connected, "connected to " + textOf(m_endpoint));
        m_input->setPeers({m_peer->status()}, 0);
    }

    const Endpoint m_endpoint;
    std::unique_ptr<QTcpSocket> m_socket; ///< while it connects
    std::unique_ptr<TcpPeer> m_peer;      ///< once it has
    log::Moment m_begun{};                ///< of this attempt
    log::Moment m_next{};                 ///< of the next attempt
    log::Duration m_pause = kFirstPause;
    std::optional<log::Moment> m_publish;
};

} // namespace

NetResult<std::unique_ptr<TcpInput>> makeTcpListener(const TcpContext& context,
                                                     const std::shared_ptr<Input>& input) {
    auto listener = std::make_unique<TcpListener>(context, input);
    if (const auto listens = listener->listen(); !listens) {
        return tl::unexpected(listens.error());
    }
    return listener;
}

std::unique_ptr<TcpInput> makeTcpDialer(const TcpContext& context, const std::shared_ptr<Input>& input) {
    return std::make_unique<TcpDialer>(context, input);
}

} // namespace posewire::net
