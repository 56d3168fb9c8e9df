// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/datagram_sender.h"

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

/// By UDP or by TCP.
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
        if (const auto written = waitUntilUnsent(kMostUnsent); !written) {
            return tl::unexpected(written.error());
        }
        return m_socket.state() == QAbstractSocket::ConnectedState ? NetResult<bool>(true) : ended();
    }

    NetResult<void> flush() override { return waitUntilUnsent(0); }

    [[nodiscard]] std::string localAddress() const override {
        return addressOf(m_socket.localAddress(), m_socket.localPort());
    }

private:
    /// Waits until at most this many bytes are unsent.
    NetResult<void> waitUntilUnsent(qint64 most) {
        while (m_socket.bytesToWrite() > most) {
            if (!m_socket.waitForBytesWritten(kPatienceMs)) {
                return ended();
            }
        }
        return {};
    }
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

NetResult<DatagramSender> DatagramSender::connect(const SendTarget& target) {
    const auto address = lookUp(target.endpoint);
    if (!address) {
        return tl::unexpected(address.error());
    }
    DatagramSender sender;
    if (target.transport == SendTarget::Transport::Udp) {
        sender.m_channel = std::make_unique<UdpChannel>(*address, target.endpoint.port);
        return sender;
    }
    auto channel = std::make_unique<TcpChannel>(target.endpoint);
    if (auto connected = channel->connect(*address); !connected) {
        return tl::unexpected(connected.error());
    }
    sender.m_channel = std::move(channel);
    return sender;
}

NetResult<void> DatagramSender::send(std::span<const std::byte> datagram) {
    const auto taken =
        m_channel->send(reinterpret_cast<const char*>(datagram.data()), static_cast<qint64>(datagram.size()));
    if (!taken) {
        return tl::unexpected(taken.error());
    }
    ++(*taken ? m_sent : m_refused);
    return {};
}

NetResult<void> DatagramSender::flush() {
    return m_channel->flush();
}

std::string DatagramSender::localAddress() const {
    return m_channel->localAddress();
}

} // namespace posewire::net
