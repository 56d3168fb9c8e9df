// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/receiving.h"

#include "app/gui/raw_file_import.h"
#include "app/net/udp_binding.h"

#include <QFileInfo>

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr int kTrialBufferBytes = 1 << 16;
constexpr std::int64_t kRateWindowNs = 1'000'000'000;

net::Endpoint endpointOf(const UdpPort& port) {
    return {port.address.toStdString(), port.port};
}

} // namespace

void Receiving::addPort(const UdpPort& port) {
    const bool isKnown =
        std::ranges::any_of(m_state.ports, [&](const PortState& state) { return state.port == port; });
    if (!isKnown) {
        m_state.ports.push_back({port, {}});
    }
    listen();
}

QString Receiving::problemOf(const UdpPort& port) {
    const auto trial = net::bindUdp(endpointOf(port), kTrialBufferBytes);
    return trial ? QString() : QString::fromStdString(trial.error().text);
}

/// Ports are tried one by one, so that each has its own answer; those that open are closed again for the
/// receiver.
std::vector<net::Endpoint> Receiving::endpointsThatOpen() {
    std::vector<net::Endpoint> endpoints;
    for (PortState& state : m_state.ports) {
        state.problem = problemOf(state.port);
        if (state.problem.isEmpty()) {
            endpoints.push_back(endpointOf(state.port));
        }
    }
    return endpoints;
}

void Receiving::addCounters() {
    if (m_receiver != nullptr) {
        m_datagramsBefore += m_receiver->counters().datagrams;
        m_bytesBefore += m_receiver->counters().bytes;
        m_droppedBefore += m_receiver->counters().kernelDropped;
    }
}

void Receiving::listen() {
    addCounters();
    m_receiver.reset();
    net::ReceiveOptions options;
    options.endpoints = endpointsThatOpen();
    if (options.endpoints.empty()) {
        return;
    }
    auto receiver = net::UdpReceiver::start(m_log, m_clock, options);
    if (receiver) {
        m_receiver = std::move(*receiver);
        takePortNumbers();
        return;
    }
    for (PortState& state : m_state.ports) {
        if (state.problem.isEmpty()) {
            state.problem = QString::fromStdString(receiver.error().text);
        }
    }
}

/// Where the system was to choose a port, its choice is kept from then on.
void Receiving::takePortNumbers() {
    auto endpoint = m_receiver->endpoints().begin();
    for (PortState& state : m_state.ports) {
        if (state.problem.isEmpty() && endpoint != m_receiver->endpoints().end()) {
            state.port.port = endpoint->port;
            ++endpoint;
        }
    }
}

void Receiving::retry() {
    const bool canImprove = std::ranges::any_of(m_state.ports, [](const PortState& state) {
        return !state.problem.isEmpty() && problemOf(state.port).isEmpty();
    });
    if (canImprove) {
        listen();
    }
}

QString Receiving::openFile(const QString& path) {
    // The log has one writer at a time: the receiver makes room, and what arrives meanwhile waits in no
    // socket.
    addCounters();
    m_receiver.reset();
    const QString problem = importRawFile(path, m_log, m_clock.wallNs());
    if (problem.isEmpty()) {
        m_state.file = QFileInfo(path).fileName();
    }
    if (!m_state.ports.empty()) {
        listen();
    }
    return problem;
}

void Receiving::measure(std::int64_t nowNs) {
    Totals totals{nowNs, m_datagramsBefore, m_bytesBefore};
    m_state.kernelDropped = m_droppedBefore;
    if (m_receiver != nullptr) {
        const net::ReceiveCounters& counters = m_receiver->counters();
        totals.datagrams += counters.datagrams;
        totals.bytes += counters.bytes;
        m_state.kernelDropped += counters.kernelDropped;
        m_state.receiveBufferBytes = counters.receiveBufferBytes;
    }
    m_totals.push_back(totals);
    while (m_totals.size() > 2 && m_totals[1].stampNs <= nowNs - kRateWindowNs) {
        m_totals.pop_front();
    }
    const Totals& before = m_totals.front();
    const double seconds = static_cast<double>(nowNs - before.stampNs) * 1e-9;
    if (seconds > 0) {
        m_state.datagramsPerSecond = static_cast<double>(totals.datagrams - before.datagrams) / seconds;
        m_state.bytesPerSecond = static_cast<double>(totals.bytes - before.bytes) / seconds;
    }
}

std::uint16_t Receiving::openPort() const {
    return m_receiver == nullptr || m_receiver->endpoints().empty() ? std::uint16_t{0}
                                                                    : m_receiver->endpoints().front().port;
}

} // namespace posewire::gui
