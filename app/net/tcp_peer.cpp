// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/tcp_peer.h"

#include "app/net/socket_options.h"

#include <QHostAddress>

#include <array>

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

} // namespace posewire::net
