// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/receiving.h"

#include "app/gui/raw_file_import.h"
#include "app/net/udp_binding.h"

#include <QFileInfo>

#include <algorithm>

namespace posewire::gui {

namespace {

using Kind = InputAddress::Kind;

constexpr int kTrialBufferBytes = 1 << 16;
constexpr std::int64_t kRateWindowNs = 1'000'000'000;

net::Endpoint endpointOf(const InputAddress& port) {
    return {port.address.toStdString(), port.port};
}

net::UdpInput udpOf(const InputAddress& port) {
    net::UdpInput input{endpointOf(port), {}};
    for (const QString& group : port.groups) {
        input.groups.push_back(group.toStdString());
    }
    return input;
}

} // namespace

void Receiving::addPort(const InputAddress& port) {
    const auto known = std::ranges::find(m_state.ports, port, &PortState::port);
    if (known != m_state.ports.end()) {
        if (!known->id) {
            open(*known);
        }
        return;
    }
    m_state.ports.push_back({port, {}});
    open(m_state.ports.back());
}

bool Receiving::removePort(const InputAddress& port) {
    const auto known = std::ranges::find(m_state.ports, port, &PortState::port);
    if (known == m_state.ports.end()) {
        return false;
    }
    if (known->id) {
        m_receiver.remove(*known->id);
    }
    m_state.ports.erase(known);
    return true;
}

void Receiving::open(PortState& state) {
    net::NetResult<net::InputId> id;
    switch (state.port.kind) {
    case Kind::Udp:
        id = m_receiver.addUdp(udpOf(state.port));
        break;
    case Kind::TcpListen:
        id = m_receiver.addTcpListener(endpointOf(state.port));
        break;
    case Kind::TcpConnect:
        id = m_receiver.addTcpConnection(endpointOf(state.port));
        break;
    }
    state.problem = id ? QString() : QString::fromStdString(id.error().text);
    if (id) {
        state.id = *id;
        readStatus();
        state.port.port = state.status.endpoint.port; // where the system was to choose one
    }
}

void Receiving::readStatus() {
    for (net::InputStatus& status : m_receiver.inputs()) {
        const auto state = std::ranges::find(m_state.ports, std::optional(status.id), &PortState::id);
        if (state != m_state.ports.end()) {
            const bool isRetrying = status.state == net::InputState::Retrying;
            state->problem = isRetrying ? QString::fromStdString(status.text) : QString();
            state->status = std::move(status);
        }
    }
}

QString Receiving::problemOf(const InputAddress& port) {
    if (port.kind != Kind::Udp) {
        return {};
    }
    const auto trial = net::bindUdp(udpOf(port), kTrialBufferBytes);
    return trial ? QString() : QString::fromStdString(net::withHolder(trial.error(), port.port, false).text);
}

void Receiving::retry() {
    for (PortState& state : m_state.ports) {
        if (!state.id) {
            open(state);
        }
    }
}

QString Receiving::openFile(const QString& path) {
    const QString problem = importRawFile(
        path,
        [this](std::span<const std::byte> bytes, const log::SourceInfo& source, const log::Arrival& arrival) {
            m_receiver.submitWaiting(bytes, source, arrival);
        },
        m_clock.wallNs());
    m_receiver.flush();
    if (problem.isEmpty()) {
        m_state.file = QFileInfo(path).fileName();
    }
    return problem;
}

void Receiving::measure(std::int64_t nowNs) {
    readStatus();
    const net::ReceiveTotals figures = m_receiver.totals();
    m_state.kernelDropped = figures.kernelDropped + figures.queueDropped;
    m_state.receiveBufferBytes = figures.receiveBufferBytes;
    m_state.longestDelayNs = figures.longestDelayNs;
    const Totals totals{nowNs, figures.datagrams, figures.bytes};
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
    const auto open = std::ranges::find_if(
        m_state.ports, [](const PortState& state) { return state.id && state.port.kind == Kind::Udp; });
    return open == m_state.ports.end() ? std::uint16_t{0} : open->port.port;
}

} // namespace posewire::gui
