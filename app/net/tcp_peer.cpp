// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/tcp_peer.h"

#include "app/net/address_text.h"
#include "app/net/receive_loop.h"

#include <QHostAddress>

#include <array>

namespace posewire::net {

namespace {

constexpr std::size_t kAtOnce = std::size_t{64} << 10;

} // namespace

TcpPeer::TcpPeer(const TcpContext& context, std::shared_ptr<Input> input, std::unique_ptr<QTcpSocket> socket,
                 std::uint16_t localPort)
    : m_context(context),
      m_input(std::move(input)),
      m_socket(std::move(socket)),
      m_sender{textOf(Endpoint{addressText(m_socket->peerAddress()), m_socket->peerPort()}),
               log::Transport::Tcp, localPort},
      m_status{m_sender.address, context.clock.wall()} {
    m_socket->setReadBufferSize(kReadBuffer);
    m_socket->setSocketOption(QAbstractSocket::KeepAliveOption, 1);
}

bool TcpPeer::read() {
    std::array<char, kAtOnce> buffer; // uninitialized: most of it is never used
    const qint64 size = m_socket->read(buffer.data(), static_cast<qint64>(buffer.size()));
    if (size <= 0) {
        return false;
    }
    const auto bytes = static_cast<std::uint64_t>(size);
    m_stamp = m_context.clock.wall();
    m_status.bytes += bytes;
    increase<std::uint64_t>(m_input->counters().bytes, bytes);
    increase<std::uint64_t>(m_context.totals.bytes, bytes);
    m_framer.push(std::as_bytes(std::span(buffer).first(static_cast<std::size_t>(size))),
                  [this](const log::TcpFramer::Piece& piece) { take(piece); });
    return m_socket->bytesAvailable() > 0;
}

bool TcpPeer::hasEnded() const {
    return m_socket->state() == QAbstractSocket::UnconnectedState && m_socket->bytesAvailable() == 0;
}

void TcpPeer::drain() {
    while (read()) {
    }
}

void TcpPeer::finish() {
    m_stamp = m_context.clock.wall();
    m_framer.finish([this](const log::TcpFramer::Piece& piece) { take(piece); });
}

void TcpPeer::take(const log::TcpFramer::Piece& piece) {
    log::Arrival arrival;
    arrival.stamp = m_stamp;
    arrival.flags.skipped = piece.kind == log::TcpFramer::Kind::Skipped;
    if (arrival.flags.skipped) {
        m_status.skippedBytes += piece.bytes.size();
        increase<std::uint64_t>(m_input->counters().skippedBytes, piece.bytes.size());
        increase<std::uint64_t>(m_context.totals.skippedBytes, piece.bytes.size());
    } else {
        ++m_status.datagrams;
        increase<std::uint64_t>(m_input->counters().datagrams, 1);
        increase<std::uint64_t>(m_context.totals.datagrams, 1);
    }
    m_context.queue.pushWaiting(piece.bytes, m_sender, arrival);
}

} // namespace posewire::net
