// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/tcp_room.h"
#include "app/net/tcp_thread.h"

#include <QHostAddress>
#include <QNetworkProxy>
#include <QTcpSocket>

#include <algorithm>

namespace posewire::net {
namespace {

constexpr log::Duration kFirstPause = std::chrono::milliseconds(250);
constexpr log::Duration kLongestPause = std::chrono::seconds(5);
/// An attempt without an answer by then has failed.
constexpr log::Duration kPatience = std::chrono::seconds(5);
/// A connection without a byte for so long is silent.
constexpr log::Duration kSilentAfter = std::chrono::seconds(5);
/// A connection without a byte may end at once, again and again: by then it has not.
constexpr log::Duration kSettled = std::chrono::seconds(1);

/// Why an attempt failed and what to do about it.
std::string failureText(const QTcpSocket& socket, const std::string& host) {
    if (std::string zone = problemWithZone(QHostAddress(QString::fromStdString(host))); !zone.empty()) {
        return zone + ".";
    }
    switch (socket.error()) {
    case QAbstractSocket::ConnectionRefusedError:
        return "connection refused; is the sender on, and does it listen there?";
    case QAbstractSocket::HostNotFoundError:
        return "no computer of that name was found; check the name, or use its address.";
    case QAbstractSocket::SocketTimeoutError:
        return "no answer; is that computer on, and does a firewall block the port?";
    default:
        return "cannot be reached: " + socket.errorString().toStdString() + "; check host and network.";
    }
}

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
            pause(now, "the sender closed the connection.");
        } else if (!m_publish) {
            m_publish = now + kPublish;
        } else if (now >= *m_publish) {
            publish(now);
        }
        return hasMore;
    }

    [[nodiscard]] std::optional<log::Moment> due() const override {
        if (m_peer) {
            return m_publish ? m_publish : m_review;
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
            publish(now);
        } else if (state == QAbstractSocket::UnconnectedState) {
            pause(now, failureText(*m_socket, m_endpoint.host));
        } else if (now - m_begun >= kPatience) {
            pause(now, "no answer; is that computer on, and does a firewall block the port?");
        }
    }

    void pause(log::Moment now, const std::string& why) {
        m_socket.reset();
        m_publish.reset();
        m_next = now + m_pause;
        const std::string problem = textOf(m_endpoint) + ": " + why + " Trying again";
        m_input->setPeers({});
        m_input->setState(InputState::Retrying, problem);
        m_input->setProblem(problem);
        m_pause = std::min(2 * m_pause, kLongestPause);
    }

    void publish(log::Moment now) {
        m_publish.reset();
        m_input->setState(InputState::Connected, "connected to " + textOf(m_endpoint));
        m_review.reset();
        if (now - m_peer->lastByte() >= kSilentAfter) {
            m_input->setProblem(textOf(m_endpoint) +
                                ": connected, but nothing has arrived for 5 s; is the sender streaming?");
        } else if (m_peer->status().bytes == 0 && now - m_begun < kSettled) {
            m_review = m_begun + kSettled;
        } else {
            m_input->setProblem({});
            m_review = m_peer->lastByte() + kSilentAfter;
        }
        m_input->setPeers({m_peer->status()});
    }

    const Endpoint m_endpoint;
    std::unique_ptr<QTcpSocket> m_socket; ///< while it connects
    std::unique_ptr<TcpPeer> m_peer;      ///< once it has
    log::Moment m_begun{};                ///< of this attempt
    log::Moment m_next{};                 ///< of the next attempt
    log::Duration m_pause = kFirstPause;
    std::optional<log::Moment> m_publish;
    std::optional<log::Moment> m_review; ///< when silence becomes a problem, or the last one is over
};

} // namespace

std::unique_ptr<TcpInput> makeTcpDialer(const TcpContext& context, const std::shared_ptr<Input>& input) {
    return std::make_unique<TcpDialer>(context, input);
}

} // namespace posewire::net
