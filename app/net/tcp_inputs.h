// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/endpoint.h"
#include "app/net/input.h"
#include "app/net/packet_queue.h"
#include "core/log/clock.h"
#include "core/log/tcp_framer.h"
#include "core/log/time.h"

#include <QTcpServer>
#include <QTcpSocket>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

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

/// An input that receives by TCP. Belongs to one thread, whose event loop runs between turns.
class TcpInput {
public:
    explicit TcpInput(std::shared_ptr<Input> input) : m_input(std::move(input)) {}
    virtual ~TcpInput() = default;
    TcpInput(const TcpInput&) = delete;
    TcpInput& operator=(const TcpInput&) = delete;

    [[nodiscard]] InputId id() const { return m_input->id(); }

    /// Does the work at hand; true if there is more that no event will announce.
    virtual bool turn(log::Moment now) = 0;

    /// When it needs a turn even without events; empty for never.
    [[nodiscard]] virtual std::optional<log::Moment> due() const = 0;

    /// Reads what has arrived, before destruction.
    virtual void drain() = 0;

protected:
    std::shared_ptr<Input> m_input;
};

/// Lets senders connect, as MVN does.
class TcpListener final : public TcpInput {
public:
    TcpListener(const TcpContext& context, std::shared_ptr<Input> input);
    NetResult<void> listen(const Endpoint& endpoint);

    bool turn(log::Moment now) override;
    [[nodiscard]] std::optional<log::Moment> due() const override { return m_publish; }
    void drain() override;

private:
    bool accept();
    void publish();

    const TcpContext& m_context;
    QTcpServer m_server;
    std::vector<std::unique_ptr<TcpPeer>> m_peers;
    std::uint64_t m_refused = 0;
    std::optional<log::Moment> m_publish; ///< when to publish the peers' counters next
};

/// Connects to a sender that listens, and reconnects.
class TcpDialer final : public TcpInput {
public:
    TcpDialer(const TcpContext& context, std::shared_ptr<Input> input, Endpoint endpoint);

    bool turn(log::Moment now) override;
    [[nodiscard]] std::optional<log::Moment> due() const override;
    void drain() override;

private:
    void begin(log::Moment now);
    void await(log::Moment now);
    void pause(log::Moment now, const std::string& why);
    void publish();

    const TcpContext& m_context;
    Endpoint m_endpoint;
    std::unique_ptr<QTcpSocket> m_socket; ///< while it connects
    std::unique_ptr<TcpPeer> m_peer;      ///< once it has
    log::Moment m_begun{};                ///< of this attempt
    log::Moment m_next{};                 ///< of the next attempt
    log::Duration m_pause;
    std::optional<log::Moment> m_publish;
};

} // namespace posewire::net
