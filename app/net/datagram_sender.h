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
        Tcp, ///< connects out, as MVN does; datagrams follow each other without anything between them
    };
    Endpoint endpoint;
    Transport transport = Transport::Udp;
};

/// Sends datagrams to one or more places. Belongs to the thread that makes it; the process needs a
/// QCoreApplication, whose loop need not run.
class DatagramSender {
public:
    /// Looks up names and connects, waiting at most five seconds for each. Fails with the first that does not
    /// work.
    static NetResult<DatagramSender> connect(const std::vector<SendTarget>& targets);

    DatagramSender(DatagramSender&&) noexcept;
    DatagramSender& operator=(DatagramSender&&) noexcept;
    ~DatagramSender();

    /// To all targets, in their order. Waits while a TCP receiver does not take what was sent before. A
    /// datagram that UDP does not take is counted, not an error; a TCP connection that ended is.
    NetResult<void> send(std::span<const std::byte> datagram);

    /// Waits until TCP has taken everything, at most five seconds.
    NetResult<void> flush();

    /// Where the datagrams come from in the eyes of each target, in their order: "127.0.0.1:40001".
    [[nodiscard]] std::vector<std::string> localAddresses() const;

    [[nodiscard]] std::uint64_t sent() const { return m_sent; } ///< datagrams, counted for each target
    [[nodiscard]] std::uint64_t refused() const {
        return m_refused;
    } ///< datagrams that the system did not take

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
