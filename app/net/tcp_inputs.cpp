// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/tcp_inputs.h"

#include "app/net/receiver.h"

#include <QHostAddress>
#include <QNetworkProxy>

#include <algorithm>
#include <cstdio>

namespace posewire::net {

namespace {

constexpr log::Duration kPublish = std::chrono::milliseconds(100);
constexpr log::Duration kFirstPause = std::chrono::milliseconds(250);
constexpr log::Duration kLongestPause = std::chrono::seconds(5);
/// An attempt without an answer by then has failed.
constexpr log::Duration kPatience = std::chrono::seconds(5);

std::string secondsText(log::Duration duration) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "%.3g s", log::secondsOf(duration));
    return text.data();
}

NetError listenError(const QTcpServer& server, const Endpoint& endpoint) {
    using Kind = NetError::Kind;
    const std::string port = "TCP port " + std::to_string(endpoint.port) +
                             (endpoint.host.empty() ? std::string() : " of " + endpoint.host);
    switch (server.serverError()) {
    case QAbstractSocket::AddressInUseError:
        return {Kind::PortInUse,
                port + " is in use by another program; close that program or choose another port"};
    case QAbstractSocket::SocketAccessError:
        return {Kind::NoPermission, port + " needs administrator rights; choose a port from 1024 up"};
    case QAbstractSocket::SocketAddressNotAvailableError:
        return {Kind::AddressNotHere, endpoint.host + " is not an address of this computer; leave it out to "
                                                      "listen on all addresses"};
    default:
        return {Kind::Other, "cannot listen on " + port + ": " + server.errorString().toStdString() +
                                 "; choose another port or address"};
    }
}

} // namespace

TcpListener::TcpListener(const TcpContext& context, std::shared_ptr<Input> input)
    : TcpInput(std::move(input)), m_context(context) {
    m_server.setProxy(QNetworkProxy::NoProxy);
}

NetResult<void> TcpListener::listen(const Endpoint& endpoint) {
    const QHostAddress address = endpoint.host.empty() ? QHostAddress(QHostAddress::Any)
                                                       : QHostAddress(QString::fromStdString(endpoint.host));
    if (address.isNull()) {
        return netError(NetError::Kind::BadEndpoint,
                        "\"" + endpoint.host +
                            "\" is not an IP address to listen on; write one, or leave it out");
    }
    if (!m_server.listen(address, endpoint.port)) {
        return tl::unexpected(listenError(m_server, endpoint));
    }
    m_input->setEndpoint({endpoint.host, m_server.serverPort()});
    publish();
    return {};
}

bool TcpListener::accept() {
    bool hasChanged = false;
    while (m_server.hasPendingConnections()) {
        std::unique_ptr<QTcpSocket> socket(m_server.nextPendingConnection());
        socket->setParent(nullptr);
        if (m_peers.size() < Receiver::kMostPeers) {
            m_peers.push_back(std::make_unique<TcpPeer>(m_context, m_input, std::move(socket),
                                                        static_cast<std::uint16_t>(m_server.serverPort())));
        } else {
            socket->abort();
            ++m_refused;
        }
        hasChanged = true;
    }
    return hasChanged;
}

bool TcpListener::turn(log::Moment now) {
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

void TcpListener::publish() {
    m_publish.reset();
    std::vector<Peer> peers;
    for (const auto& peer : m_peers) {
        peers.push_back(peer->status());
    }
    m_input->setState(InputState::Listening, peers.empty() ? "listening; nobody has connected"
                                                           : std::to_string(peers.size()) + " connected");
    m_input->setPeers(std::move(peers), m_refused);
}

void TcpListener::drain() {
    for (const auto& peer : m_peers) {
        peer->drain();
    }
}

TcpDialer::TcpDialer(const TcpContext& context, std::shared_ptr<Input> input, Endpoint endpoint)
    : TcpInput(std::move(input)), m_context(context), m_endpoint(std::move(endpoint)), m_pause(kFirstPause) {}

bool TcpDialer::turn(log::Moment now) {
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

void TcpDialer::begin(log::Moment now) {
    m_begun = now;
    m_socket = std::make_unique<QTcpSocket>();
    m_socket->setProxy(QNetworkProxy::NoProxy);
    m_socket->setReadBufferSize(TcpPeer::kReadBuffer);
    m_socket->connectToHost(m_endpoint.host.empty() ? QStringLiteral("127.0.0.1")
                                                    : QString::fromStdString(m_endpoint.host),
                            m_endpoint.port);
    m_input->setState(InputState::Connecting, "connecting to " + textOf(m_endpoint));
}

void TcpDialer::await(log::Moment now) {
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

void TcpDialer::pause(log::Moment now, const std::string& why) {
    m_socket.reset();
    m_publish.reset();
    m_next = now + m_pause;
    m_input->setPeers({}, 0);
    m_input->setState(InputState::Retrying, why + "; trying again in " + secondsText(m_pause));
    m_pause = std::min(2 * m_pause, kLongestPause);
}

void TcpDialer::publish() {
    m_publish.reset();
    m_input->setState(InputState::Connected, "connected to " + textOf(m_endpoint));
    m_input->setPeers({m_peer->status()}, 0);
}

std::optional<log::Moment> TcpDialer::due() const {
    if (m_peer) {
        return m_publish;
    }
    return m_socket ? m_begun + kPatience : m_next;
}

void TcpDialer::drain() {
    if (m_peer) {
        m_peer->drain();
    }
}

} // namespace posewire::net
