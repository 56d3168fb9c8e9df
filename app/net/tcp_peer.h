// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/input.h"
#include "app/net/packet_queue.h"
#include "core/log/clock.h"
#include "core/log/tcp_framer.h"

#include <QTcpSocket>

#include <memory>

namespace posewire::net {

/// What a TCP connection works with; outlives it.
struct TcpContext {
    const log::Clock& clock;
    PacketQueue& queue;
    InputCounters& totals;
};

/// One TCP connection: cuts its bytes into datagrams and hands them on. Of its own it keeps at most
/// kReadBuffer and what the framer keeps. Belongs to one thread.
class TcpPeer {
public:
    static constexpr qint64 kReadBuffer = qint64{128} << 10;

    /// `socket` is connected. `localPort` is what the sender is told to have arrived at.
    TcpPeer(const TcpContext& context, std::shared_ptr<Input> input, std::unique_ptr<QTcpSocket> socket,
            std::uint16_t localPort);

    /// Reads some of what is there, so that others have their turn; true where there is more. Waits while the
    /// queue is full.
    bool read();

    /// The other end has closed, or was lost, and everything it sent was read.
    [[nodiscard]] bool hasEnded() const;

    /// Reads what has arrived here, without waiting for more. For an end that is ours: an unfinished datagram
    /// is then nobody's fault and not told.
    void drain();

    /// What an end inside a datagram leaves over comes out. After hasEnded().
    void finish();

    [[nodiscard]] const Peer& status() const { return m_status; }
    [[nodiscard]] QTcpSocket& socket() { return *m_socket; }

private:
    void take(const log::TcpFramer::Piece& piece);

    const TcpContext& m_context;
    std::shared_ptr<Input> m_input;
    std::unique_ptr<QTcpSocket> m_socket;
    log::SenderInfo m_sender;
    log::TcpFramer m_framer;
    std::int64_t m_stampNs = 0; ///< of what is being read
    Peer m_status;
};

} // namespace posewire::net
