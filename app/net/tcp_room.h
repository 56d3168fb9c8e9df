// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/tcp_thread.h"
#include "core/log/tcp_framer.h"

#include <QTcpSocket>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace posewire::net {

inline constexpr qint64 kReadBuffer = qint64{128} << 10;
inline constexpr log::Duration kPublish = std::chrono::milliseconds(100);

/// One TCP connection: splits its bytes into datagrams and passes them on.
class TcpPeer {
public:
    /// How much a connection has a claim to its place, least first. Bytes alone are no claim: who trickles
    /// them would never give way. A whole datagram is.
    enum class Claim : std::uint8_t {
        HalfOpen, ///< no whole datagram, though it has been connected for kHalfOpen
        Idle,     ///< no whole datagram for kIdle
        New,      ///< no whole datagram so far
        Quiet,    ///< no whole datagram for kQuiet: one was sent to hold the place
        Active,
    };
    static constexpr log::Duration kQuiet = std::chrono::seconds(5);
    static constexpr log::Duration kHalfOpen = std::chrono::seconds(10);
    static constexpr log::Duration kIdle = std::chrono::seconds(30);

    /// `socket` is connected. `localPort` is recorded as the port that the sender's data arrived at.
    TcpPeer(const TcpContext& context, std::shared_ptr<Input> input, std::unique_ptr<QTcpSocket> socket,
            std::uint16_t localPort);

    /// Reads a bounded amount, so that others get a turn; true if there is more. Blocks while the queue is
    /// full.
    bool read();

    /// The other end closed or was lost, and everything it sent has been read.
    [[nodiscard]] bool hasEnded() const {
        return m_socket->state() == QAbstractSocket::UnconnectedState && m_socket->bytesAvailable() == 0;
    }

    /// Reads what has arrived, in the system's buffers too, without waiting for more. For closing from this
    /// side: an unfinished datagram is then nobody's fault and is not reported.
    void drain();

    /// Passes on the rest of a connection that ended inside a datagram. After hasEnded() or drain().
    void finish();

    [[nodiscard]] const Peer& status() const { return m_status; }
    [[nodiscard]] Claim claimAt(log::Moment now) const;
    /// When its last whole datagram came, else when it connected.
    [[nodiscard]] log::Moment lastDatagram() const { return m_lastDatagram; }
    /// When its last byte came, else when it connected.
    [[nodiscard]] log::Moment lastByte() const { return m_lastByte; }
    [[nodiscard]] bool isAllowed() const { return m_context.allowed.allows(m_socket->peerAddress()); }

private:
    void take(const log::TcpFramer::Piece& piece);

    const TcpContext& m_context;
    std::shared_ptr<Input> m_input;
    std::unique_ptr<QTcpSocket> m_socket;
    log::SenderInfo m_sender;
    log::TcpFramer m_framer;
    log::Stamp m_stamp{}; ///< of the bytes being read
    log::Moment m_lastByte;
    log::Moment m_lastDatagram;
    Peer m_status;
};

/// The connections of one listener, Receiver::kMostPeers at most: who is let in, who gives way, and what is
/// told of it. Of one thread, as TcpInput.
class TcpRoom {
public:
    TcpRoom(const TcpContext& context, std::shared_ptr<Input> input)
        : m_context(context), m_input(std::move(input)) {}

    /// `socket` has connected to `localPort`. Lets it in, in the place of the one with the least claim where
    /// there is no other, or closes it.
    void admit(std::unique_ptr<QTcpSocket> socket, std::uint16_t localPort);

    // As of TcpInput.
    bool turn(log::Moment now);
    [[nodiscard]] std::optional<log::Moment> due() const { return m_publish; }
    void drain();
    void heedAllowed();

    void publish();

private:
    bool makeRoom();
    [[nodiscard]] std::string note() const;

    const TcpContext& m_context;
    std::shared_ptr<Input> m_input;
    std::vector<std::unique_ptr<TcpPeer>> m_peers;
    bool m_hasChanged = false;            ///< who is connected, since the last publish()
    std::uint64_t m_closed = 0;           ///< to make room
    std::uint64_t m_tooMany = 0;          ///< refused because there was none
    std::uint64_t m_elsewhere = 0;        ///< from those who are not listened to
    std::optional<log::Moment> m_publish; ///< when to publish the peers' counters next
};

} // namespace posewire::net
