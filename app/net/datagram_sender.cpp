// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/datagram_sender.h"

#include "app/net/addresses.h"

#include <QHostAddress>
#include <QTcpSocket>
#include <QUdpSocket>

#include <thread>

namespace posewire::net {

namespace {

constexpr int kPatienceMs = 5000;
/// Once this much is unsent, a TCP receiver that reads nothing makes the sender wait.
constexpr qint64 kMostUnsent = 1 << 20;

std::string addressOf(const QHostAddress& address, quint16 port) {
    return net::textOf(Endpoint{address.toString().toStdString(), port});
}

} // namespace

SendSchedule::SendSchedule(const log::Clock& clock, Sleep sleep)
    : m_clock(clock), m_sleep(std::move(sleep)), m_start(clock.monotonic()) {
    if (!m_sleep) {
        m_sleep = [](log::Duration duration) { std::this_thread::sleep_for(duration); };
    }
}

log::Duration SendSchedule::waitUntil(log::Duration afterStart) {
    while (true) {
        const log::Duration late = elapsed() - afterStart;
        if (late >= log::Duration::zero()) {
            return late;
        }
        m_sleep(-late);
    }
}

/// One target.
class DatagramSender::Channel {
public:
    virtual ~Channel() = default;
    /// False if the datagram was refused for good.
    virtual NetResult<bool> send(const char* bytes, qint64 size) = 0;
    virtual NetResult<void> flush() = 0;
    [[nodiscard]] virtual std::string localAddress() const = 0;
};

class DatagramSender::UdpChannel final : public Channel {
public:
    UdpChannel(const QHostAddress& address, quint16 port) : m_address(address), m_port(port) {
        const bool isIpv4 = m_address.protocol() == QAbstractSocket::IPv4Protocol;
        m_socket.bind(isIpv4 ? QHostAddress::AnyIPv4 : QHostAddress::AnyIPv6, 0);
    }

    NetResult<bool> send(const char* bytes, qint64 size) override {
        return m_socket.writeDatagram(bytes, size, m_address, m_port) == size;
    }
    NetResult<void> flush() override { return {}; }

    /// The system chooses the local address when it sends; connecting a socket without sending reveals it.
    [[nodiscard]] std::string localAddress() const override {
        QUdpSocket probe;
        probe.connectToHost(m_address, m_port);
        const QHostAddress address = probe.waitForConnected(0) ? probe.localAddress() : QHostAddress();
        return addressOf(address.isNull() ? m_socket.localAddress() : address, m_socket.localPort());
    }

private:
    QUdpSocket m_socket;
    QHostAddress m_address;
    quint16 m_port;
};

class DatagramSender::TcpChannel final : public Channel {
public:
    explicit TcpChannel(Endpoint endpoint) : m_endpoint(std::move(endpoint)) {}

    NetResult<void> connect(const QHostAddress& address) {
        m_socket.connectToHost(address, m_endpoint.port);
        if (!m_socket.waitForConnected(kPatienceMs)) {
            return netError(NetError::Kind::NotConnected,
                            "cannot connect to " + net::textOf(m_endpoint) +
                                " by TCP: " + m_socket.errorString().toStdString() +
                                "; start the receiver first and check address and port");
        }
        m_socket.setSocketOption(QAbstractSocket::LowDelayOption, 1);
        return {};
    }

    NetResult<bool> send(const char* bytes, qint64 size) override {
        if (m_socket.write(bytes, size) != size) {
            return ended();
        }
        m_socket.flush();
        while (m_socket.bytesToWrite() > kMostUnsent) {
            if (!m_socket.waitForBytesWritten(kPatienceMs)) {
                return ended();
            }
        }
        return m_socket.state() == QAbstractSocket::ConnectedState ? NetResult<bool>(true) : ended();
    }

    NetResult<void> flush() override {
        while (m_socket.bytesToWrite() > 0) {
            if (!m_socket.waitForBytesWritten(kPatienceMs)) {
                return ended();
            }
        }
        return {};
    }

    [[nodiscard]] std::string localAddress() const override {
        return addressOf(m_socket.localAddress(), m_socket.localPort());
    }

private:
    [[nodiscard]] tl::unexpected<NetError> ended() const {
        return netError(NetError::Kind::NotConnected, "the TCP connection to " + net::textOf(m_endpoint) +
                                                          " ended: " + m_socket.errorString().toStdString() +
                                                          "; restart the receiver and connect again");
    }

    Endpoint m_endpoint;
    QTcpSocket m_socket;
};

DatagramSender::DatagramSender() = default;
DatagramSender::DatagramSender(DatagramSender&&) noexcept = default;
DatagramSender& DatagramSender::operator=(DatagramSender&&) noexcept = default;
DatagramSender::~DatagramSender() = default;

NetResult<DatagramSender> DatagramSender::connect(const std::vector<SendTarget>& targets) {
    DatagramSender sender;
    for (const SendTarget& target : targets) {
        const auto address = lookUp(target.endpoint);
        if (!address) {
            return tl::unexpected(address.error());
        }
        if (target.transport == SendTarget::Transport::Udp) {
            sender.m_channels.push_back(std::make_unique<UdpChannel>(*address, target.endpoint.port));
            continue;
        }
        auto channel = std::make_unique<TcpChannel>(target.endpoint);
        if (auto connected = channel->connect(*address); !connected) {
            return tl::unexpected(connected.error());
        }
        sender.m_channels.push_back(std::move(channel));
    }
    return sender;
}

NetResult<void> DatagramSender::send(std::span<const std::byte> datagram) {
    const char* bytes = reinterpret_cast<const char*>(datagram.data());
    for (const auto& channel : m_channels) {
        const auto taken = channel->send(bytes, static_cast<qint64>(datagram.size()));
        if (!taken) {
            return tl::unexpected(taken.error());
        }
        ++(*taken ? m_sent : m_refused);
    }
    return {};
}

NetResult<void> DatagramSender::flush() {
    for (const auto& channel : m_channels) {
        if (auto flushed = channel->flush(); !flushed) {
            return flushed;
        }
    }
    return {};
}

std::vector<std::string> DatagramSender::localAddresses() const {
    std::vector<std::string> addresses;
    for (const auto& channel : m_channels) {
        addresses.push_back(channel->localAddress());
    }
    return addresses;
}

} // namespace posewire::net
