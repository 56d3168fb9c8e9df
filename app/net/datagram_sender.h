// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/endpoint.h"
#include "core/log/clock.h"
#include "core/log/time.h"

#include <QHostAddress>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

class QTcpSocket;
class QUdpSocket;

namespace posewire::net {

/// When to send: every deadline counts from one start, so late wake-ups never add up to drift.
class SendSchedule {
public:
    using Sleep = std::function<void(log::Duration)>;

    /// Starts now. `sleep` is for tests; by default the thread sleeps.
    explicit SendSchedule(const log::Clock& clock, Sleep sleep = {});

    /// Starts now instead: for what takes a while before its first datagram.
    void startNow() { m_start = m_clock.monotonic(); }

    /// Sleeps until that long after the start, or not at all if it has passed. Returns how late it is.
    log::Duration waitUntil(log::Duration afterStart);

    [[nodiscard]] log::Duration elapsed() const { return m_clock.monotonic() - m_start; }

private:
    const log::Clock& m_clock;
    Sleep m_sleep;
    log::Moment m_start;
};

struct SendTarget {
    enum class Transport : std::uint8_t {
        Udp,
        Tcp, ///< connects out, as MVN does; datagrams follow each other back to back
    };
    Endpoint endpoint;
    Transport transport = Transport::Udp;
};

/// Sends datagrams to one place. Belongs to the thread that created it; the process needs a
/// QCoreApplication, but its event loop need not run.
class DatagramSender {
public:
    /// Resolves the name and connects, waiting at most five seconds.
    static NetResult<DatagramSender> connect(const SendTarget& target);

    DatagramSender(DatagramSender&&) noexcept;
    DatagramSender& operator=(DatagramSender&&) noexcept;
    ~DatagramSender();

    /// Blocks while a TCP receiver has not read earlier data. A datagram that
    /// UDP refuses is counted, not an error; a closed TCP connection is an error.
    NetResult<void> send(std::span<const std::byte> datagram);

    /// Waits at most five seconds for TCP to send everything.
    NetResult<void> flush() { return m_tcp ? waitUntilUnsent(0) : NetResult<void>(); }

    /// The address that the target sees as the sender's: "127.0.0.1:40001".
    [[nodiscard]] std::string localAddress() const;

    [[nodiscard]] std::uint64_t sent() const { return m_sent; }       ///< datagrams
    [[nodiscard]] std::uint64_t refused() const { return m_refused; } ///< datagrams that the system refused

private:
    DatagramSender(const Endpoint& target, const QHostAddress& address);
    NetResult<void> waitUntilUnsent(qint64 most);
    [[nodiscard]] tl::unexpected<NetError> ended() const;

    Endpoint m_target;
    QHostAddress m_address; ///< of the target
    std::unique_ptr<QUdpSocket> m_udp;
    std::unique_ptr<QTcpSocket> m_tcp; ///< there is one of the two
    std::uint64_t m_sent = 0;
    std::uint64_t m_refused = 0;
};

} // namespace posewire::net
