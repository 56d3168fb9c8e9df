// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/input.h"
#include "app/net/packet_queue.h"
#include "core/log/clock.h"
#include "core/log/tcp_framer.h"
#include "core/log/time.h"

#include <QTcpSocket>

#include <memory>

namespace posewire::net {

/// What a TCP connection works with; must outlive it.
struct TcpContext {
    const log::Clock& clock;
    PacketQueue& queue;
    InputCounters& totals;
};

/// One TCP connection: splits its bytes into datagrams and passes them on. Buffers at most kReadBuffer plus
/// what the framer keeps. Belongs to one thread.
class TcpPeer {
public:
    static constexpr qint64 kReadBuffer = qint64{128} << 10;

    /// `socket` is connected. `localPort` is recorded as the port that the sender's data arrived at.
    TcpPeer(const TcpContext& context, std::shared_ptr<Input> input, std::unique_ptr<QTcpSocket> socket,
            std::uint16_t localPort);

    /// Reads a bounded amount, so that others get a turn; true if there is more. Blocks while the queue is
    /// full.
    bool read();

    /// The other end closed or was lost, and everything it sent has been read.
    [[nodiscard]] bool hasEnded() const;

    /// Reads what has arrived, without waiting for more. For closing from this side: an unfinished datagram
    /// is then nobody's fault and is not reported.
    void drain();

    /// Passes on the rest of a connection that ended inside a datagram. After hasEnded().
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
    log::Stamp m_stamp{}; ///< of the bytes being read
    Peer m_status;
};

} // namespace posewire::net
