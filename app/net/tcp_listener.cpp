// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/listening.h"
#include "app/net/receiver.h"
#include "app/net/tcp_peer.h"
#include "app/net/tcp_thread.h"

#include <QHostAddress>
#include <QNetworkProxy>
#include <QTcpServer>

#include <algorithm>
#include <tuple>

namespace posewire::net {
namespace {

/// "1 idle connection was closed to make room", "2 connections were refused: 64 are open and in use".
std::string counted(std::uint64_t count, const std::string& adjective, const std::string& what) {
    return std::to_string(count) + ' ' + adjective + (count == 1 ? "connection was " : "connections were ") +
           what;
}

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

    void heedAllowed() override {
        const auto isElsewhere = [](const auto& peer) { return !peer->isAllowed(); };
        for (const auto& peer : m_peers) {
            if (isElsewhere(peer)) {
                peer->drain(); // it was listened to until now
            }
        }
        m_elsewhere += std::erase_if(m_peers, isElsewhere);
        publish();
    }

private:
    bool accept() {
        bool hasChanged = false;
        while (m_server.hasPendingConnections()) {
            std::unique_ptr<QTcpSocket> socket(m_server.nextPendingConnection());
            socket->setParent(nullptr);
            hasChanged = true;
            if (!m_context.allowed.allows(socket->peerAddress())) {
                socket->abort();
                ++m_elsewhere;
            } else if (m_peers.size() < Receiver::kMostPeers || makeRoom()) {
                m_peers.push_back(
                    std::make_unique<TcpPeer>(m_context, m_input, std::move(socket), m_server.serverPort()));
            } else {
                socket->abort();
                ++m_tooMany;
            }
        }
        return hasChanged;
    }

    /// Closes the connection with the least claim to its place, the longest silent of them. False where all
    /// are in use.
    bool makeRoom() {
        while (true) {
            const log::Moment now = m_context.clock.monotonic();
            const auto least = std::ranges::min_element(m_peers, {}, [now](const auto& peer) {
                return std::tuple(peer->claimAt(now), peer->lastDatagram());
            });
            if ((*least)->claimAt(now) == TcpPeer::Claim::Active) {
                return false;
            }
            const std::uint64_t before = (*least)->status().datagrams;
            (*least)->drain();
            if ((*least)->status().datagrams != before) {
                continue; // it only had not been read yet
            }
            (*least)->finish();
            m_peers.erase(least);
            ++m_closed;
            return true;
        }
    }

    [[nodiscard]] std::string note() const {
        std::string note;
        const auto add = [&](std::uint64_t count, const std::string& text) {
            note += count == 0 ? std::string() : (note.empty() ? "" : "; ") + text;
        };
        add(m_closed, counted(m_closed, "idle ", "closed to make room"));
        add(m_tooMany, counted(m_tooMany, "",
                               "refused: " + std::to_string(Receiver::kMostPeers) + " are open and in use"));
        add(m_elsewhere, counted(m_elsewhere, "", "closed: only chosen hosts are listened to"));
        return note;
    }

    void publish() {
        m_publish.reset();
        std::vector<Peer> peers;
        for (const auto& peer : m_peers) {
            peers.push_back(peer->status());
        }
        const std::string what = note();
        m_input->counters().closedPeers = m_closed;
        m_input->counters().refusedPeers = m_tooMany + m_elsewhere;
        m_input->setState(InputState::Listening,
                          (peers.empty() ? "listening; nobody has connected"
                                         : std::to_string(peers.size()) + " connected") +
                              (what.empty() ? "" : "; " + what));
        m_input->setPeers(std::move(peers), what);
    }

    QTcpServer m_server;
    std::vector<std::unique_ptr<TcpPeer>> m_peers;
    std::uint64_t m_closed = 0;           ///< to make room
    std::uint64_t m_tooMany = 0;          ///< refused because there was none
    std::uint64_t m_elsewhere = 0;        ///< from those who are not listened to
    std::optional<log::Moment> m_publish; ///< when to publish the peers' counters next
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

} // namespace posewire::net
