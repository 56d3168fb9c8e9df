// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/tcp_room.h"

#include "app/net/receiver.h"

#include <QHostAddress>

#include <algorithm>
#include <tuple>
#include <utility>

namespace posewire::net {
namespace {

/// "1 idle connection was closed to make room", "2 connections were refused: 64 are open and in use".
std::string counted(std::uint64_t count, const std::string& adjective, const std::string& what) {
    return std::to_string(count) + ' ' + adjective + (count == 1 ? "connection was " : "connections were ") +
           what;
}

} // namespace

void TcpRoom::admit(std::unique_ptr<QTcpSocket> socket, std::uint16_t localPort) {
    m_hasChanged = true;
    if (!m_context.allowed.allows(socket->peerAddress())) {
        socket->abort();
        ++m_elsewhere;
    } else if (m_peers.size() < Receiver::kMostPeers || makeRoom()) {
        m_peers.push_back(std::make_unique<TcpPeer>(m_context, m_input, std::move(socket), localPort));
    } else {
        socket->abort();
        ++m_tooMany;
    }
}

bool TcpRoom::turn(log::Moment now) {
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
    m_hasChanged |= std::erase_if(m_peers, [](const auto& peer) { return peer->hasEnded(); }) != 0;
    if (m_hasChanged || (m_publish && now >= *m_publish)) {
        publish();
    } else if (hasRead && !m_publish) {
        m_publish = now + kPublish;
    }
    return hasMore;
}

void TcpRoom::drain() {
    for (const auto& peer : m_peers) {
        peer->drain();
    }
}

void TcpRoom::heedAllowed() {
    const auto isElsewhere = [](const auto& peer) { return !peer->isAllowed(); };
    for (const auto& peer : m_peers) {
        if (isElsewhere(peer)) {
            peer->drain(); // it was listened to until now
        }
    }
    m_elsewhere += std::erase_if(m_peers, isElsewhere);
    publish();
}

/// Closes the connection with the least claim to its place, the longest silent of them. False if all
/// are in use.
bool TcpRoom::makeRoom() {
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

std::string TcpRoom::note() const {
    std::string note;
    const auto add = [&](std::uint64_t count, const std::string& text) {
        note += count == 0 ? std::string() : (note.empty() ? "" : "; ") + text;
    };
    add(m_closed, counted(m_closed, "idle ", "closed to make room"));
    add(m_tooMany,
        counted(m_tooMany, "", "refused: " + std::to_string(Receiver::kMostPeers) + " are open and in use"));
    add(m_elsewhere, counted(m_elsewhere, "", "closed: only chosen hosts are listened to"));
    return note;
}

void TcpRoom::publish() {
    m_hasChanged = false;
    m_publish.reset();
    std::vector<Peer> peers;
    for (const auto& peer : m_peers) {
        peers.push_back(peer->status());
    }
    const std::string what = note();
    m_input->counters().closedPeers = m_closed;
    m_input->counters().refusedPeers = m_tooMany + m_elsewhere;
    m_input->setState(InputState::Listening, (peers.empty() ? "listening; nobody has connected"
                                                            : std::to_string(peers.size()) + " connected") +
                                                 (what.empty() ? "" : "; " + what));
    m_input->setPeers(std::move(peers), what);
}

} // namespace posewire::net
