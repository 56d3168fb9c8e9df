// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/tcp_room.h"

#include "app/net/receiver.h"
#include "app/net/socket_options.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace posewire::net {

namespace {

/// More than the system's buffers hold of one connection: who sends without end does not keep us from
/// closing.
constexpr int kMostReads = 512;

} // namespace

TcpPeer::TcpPeer(const TcpContext& context, std::shared_ptr<Input> input, std::unique_ptr<QTcpSocket> socket,
                 std::uint16_t localPort)
    : m_context(context),
      m_input(std::move(input)),
      m_socket(std::move(socket)),
      m_sender{textOf(m_socket->peerAddress(), m_socket->peerPort()), log::Transport::Tcp, localPort},
      m_lastByte(context.clock.monotonic()),
      m_lastDatagram(m_lastByte),
      m_status{m_sender.address, context.now()} {
    m_socket->setReadBufferSize(kReadBuffer);
    keepAlive(*m_socket);
}

bool TcpPeer::read() {
    std::array<char, std::size_t{64} << 10> buffer; // uninitialized: most of it is never used
    const qint64 size = m_socket->read(buffer.data(), static_cast<qint64>(buffer.size()));
    if (size <= 0) {
        return false;
    }
    const auto bytes = static_cast<std::uint64_t>(size);
    m_stamp = m_context.now();
    m_lastByte = m_context.clock.monotonic();
    m_status.bytes += bytes;
    increase(m_input->counters().bytes, bytes);
    m_framer.push(std::as_bytes(std::span(buffer).first(static_cast<std::size_t>(size))),
                  [this](const log::TcpFramer::Piece& piece) { take(piece); });
    return m_socket->bytesAvailable() > 0;
}

void TcpPeer::drain() {
    for (int i = 0; i < kMostReads; ++i) {
        // Qt's own buffer is filled by events, and there will be none.
        if (!read() && !m_socket->waitForReadyRead(0) && m_socket->bytesAvailable() == 0) {
            return;
        }
    }
}

void TcpPeer::finish() {
    m_stamp = m_context.now();
    m_framer.finish([this](const log::TcpFramer::Piece& piece) { take(piece); });
}

TcpPeer::Claim TcpPeer::claimAt(log::Moment now) const {
    const bool hasSentOne = m_status.datagrams != 0;
    const log::Duration silence = now - m_lastDatagram;
    if (!hasSentOne) {
        return silence >= kHalfOpen ? Claim::HalfOpen : Claim::New;
    }
    if (silence >= kIdle) {
        return Claim::Idle;
    }
    return silence >= kQuiet ? Claim::Quiet : Claim::Active;
}

void TcpPeer::take(const log::TcpFramer::Piece& piece) {
    log::Arrival arrival;
    arrival.stamp = m_stamp;
    arrival.flags.skipped = piece.kind == log::TcpFramer::Kind::Skipped;
    if (arrival.flags.skipped) {
        m_status.skippedBytes += piece.bytes.size();
        increase(m_input->counters().skippedBytes, piece.bytes.size());
    } else {
        ++m_status.datagrams;
        m_lastDatagram = m_lastByte;
        increase(m_input->counters().datagrams, 1);
    }
    m_context.queue.push(piece.bytes, m_sender, arrival);
}

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
