// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/datagram_sender.h"

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

DatagramSender::DatagramSender(const Endpoint& target, const QHostAddress& address)
    : m_target(target), m_address(address) {}
DatagramSender::DatagramSender(DatagramSender&&) noexcept = default;
DatagramSender& DatagramSender::operator=(DatagramSender&&) noexcept = default;
DatagramSender::~DatagramSender() = default;

NetResult<DatagramSender> DatagramSender::connect(const SendTarget& target) {
    const auto address = lookUp(target.endpoint);
    if (!address) {
        return tl::unexpected(address.error());
    }
    DatagramSender sender(target.endpoint, *address);
    if (target.transport == SendTarget::Transport::Udp) {
        const bool isIpv4 = address->protocol() == QAbstractSocket::IPv4Protocol;
        sender.m_udp = std::make_unique<QUdpSocket>();
        sender.m_udp->bind(isIpv4 ? QHostAddress::AnyIPv4 : QHostAddress::AnyIPv6, 0);
        return sender;
    }
    sender.m_tcp = std::make_unique<QTcpSocket>();
    sender.m_tcp->connectToHost(*address, target.endpoint.port);
    if (!sender.m_tcp->waitForConnected(kPatienceMs)) {
        return netError(NetError::Kind::NotConnected,
                        "cannot connect to " + textOf(target.endpoint) +
                            " by TCP: " + sender.m_tcp->errorString().toStdString() +
                            "; start the receiver first and check address and port");
    }
    sender.m_tcp->setSocketOption(QAbstractSocket::LowDelayOption, 1);
    return sender;
}

NetResult<void> DatagramSender::send(std::span<const std::byte> datagram) {
    const char* bytes = reinterpret_cast<const char*>(datagram.data());
    const auto size = static_cast<qint64>(datagram.size());
    if (m_udp) {
        ++(m_udp->writeDatagram(bytes, size, m_address, m_target.port) == size ? m_sent : m_refused);
        return {};
    }
    if (m_tcp->write(bytes, size) != size) {
        return ended();
    }
    m_tcp->flush();
    if (auto written = waitUntilUnsent(kMostUnsent); !written) {
        return written;
    }
    if (m_tcp->state() != QAbstractSocket::ConnectedState) {
        return ended();
    }
    ++m_sent;
    return {};
}

/// Waits until TCP has at most this many bytes left to send.
NetResult<void> DatagramSender::waitUntilUnsent(qint64 most) {
    while (m_tcp->bytesToWrite() > most) {
        if (!m_tcp->waitForBytesWritten(kPatienceMs)) {
            return ended();
        }
    }
    return {};
}

tl::unexpected<NetError> DatagramSender::ended() const {
    return netError(NetError::Kind::NotConnected, "the TCP connection to " + textOf(m_target) +
                                                      " ended: " + m_tcp->errorString().toStdString() +
                                                      "; restart the receiver and connect again");
}

std::string DatagramSender::localAddress() const {
    if (m_tcp) {
        return addressOf(m_tcp->localAddress(), m_tcp->localPort());
    }
    // The system chooses the local address when it sends; connecting a socket without sending reveals it.
    QUdpSocket probe;
    probe.connectToHost(m_address, m_target.port);
    const QHostAddress address = probe.waitForConnected(0) ? probe.localAddress() : QHostAddress();
    return addressOf(address.isNull() ? m_udp->localAddress() : address, m_udp->localPort());
}

} // namespace posewire::net
