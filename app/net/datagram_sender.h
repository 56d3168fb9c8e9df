// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/endpoint.h"
#include "app/net/net_error.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace posewire::net {

struct SendTarget {
    enum class Transport : std::uint8_t {
        Udp,
        Tcp, ///< connects out, as MVN does; datagrams follow each other back to back
    };
    Endpoint endpoint;
    Transport transport = Transport::Udp;
};

/// Sends datagrams to one or more places. Belongs to the thread that created it; the process needs a
/// QCoreApplication, but its event loop need not run.
class DatagramSender {
public:
    /// Resolves names and connects, waiting at most five seconds for each target. Returns the first error.
    static NetResult<DatagramSender> connect(const std::vector<SendTarget>& targets);

    DatagramSender(DatagramSender&&) noexcept;
    DatagramSender& operator=(DatagramSender&&) noexcept;
    ~DatagramSender();

    /// Sends to all targets in order. Blocks while a TCP receiver has not read earlier data. A datagram that
    /// UDP refuses is counted, not an error; a closed TCP connection is an error.
    NetResult<void> send(std::span<const std::byte> datagram);

    /// Waits at most five seconds for TCP to send everything.
    NetResult<void> flush();

    /// The address that each target sees as the sender's, in order: "127.0.0.1:40001".
    [[nodiscard]] std::vector<std::string> localAddresses() const;

    [[nodiscard]] std::uint64_t sent() const { return m_sent; }       ///< datagrams, counted for each target
    [[nodiscard]] std::uint64_t refused() const { return m_refused; } ///< datagrams that the system refused

private:
    class Channel;
    class UdpChannel;
    class TcpChannel;

    DatagramSender();

    std::vector<std::unique_ptr<Channel>> m_channels;
    std::uint64_t m_sent = 0;
    std::uint64_t m_refused = 0;
};

} // namespace posewire::net
