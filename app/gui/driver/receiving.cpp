// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/receiving.h"

#include "app/gui/base/background.h"
#include "app/gui/base/logging.h"

#include <QCoreApplication>

#include <algorithm>
#include <utility>

namespace posewire::gui {

namespace {

using Kind = InputAddress::Kind;

constexpr log::Duration kRateWindow = std::chrono::seconds(1);
constexpr log::Duration kExamine = std::chrono::milliseconds(250);

net::Endpoint endpointOf(const InputAddress& port) {
    return {port.address.toStdString(), port.port};
}

net::UdpInput udpOf(const InputAddress& port) {
    net::UdpInput input{endpointOf(port), {}};
    std::ranges::transform(port.groups, std::back_inserter(input.groups), &QString::toStdString);
    return input;
}

/// One keeps the other from being opened.
bool useTheSame(const InputAddress& a, const InputAddress& b) {
    const bool isWide = a.address.isEmpty() || b.address.isEmpty();
    return a.kind == b.kind && a.port == b.port &&
           (a.address == b.address || (isWide && a.kind != Kind::TcpConnection));
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

void Receiving::addPort(const InputAddress& port, std::size_t row) {
    const std::size_t before = m_state.ports.size();
    addPort(port);
    if (m_state.ports.size() > before && row < before) {
        std::rotate(m_state.ports.begin() + static_cast<std::ptrdiff_t>(row), m_state.ports.end() - 1,
                    m_state.ports.end());
    }
}

bool Receiving::removePort(const InputAddress& port) {
    const auto known = std::ranges::find(m_state.ports, port, &PortState::port);
    if (known == m_state.ports.end()) {
        return false;
    }
    qCInfo(inputsLog).noquote() << displayText(port) << "is closed";
    if (known->id) {
        m_receiver.remove(*known->id);
        m_portRates.erase(*known->id);
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
    case Kind::TcpListener:
        m_watch.closeDoor();
        id = m_receiver.addTcpListener(endpointOf(state.port));
        break;
    case Kind::TcpConnection:
        id = m_receiver.addTcpConnection(endpointOf(state.port));
        break;
    }
    const QString before =
        std::exchange(state.problem, id ? QString() : QString::fromStdString(id.error().text));
    if (!id && state.problem != before) { // it is tried again and again
        qCInfo(inputsLog).noquote() << state.problem;
    }
    if (id) {
        state.id = *id;
        readStatus();
        state.port.port = state.status.endpoint.port; // if the system was to choose one
        qCInfo(inputsLog).noquote() << displayText(state.port) << "is open";
    }
}

void Receiving::readStatus() {
    for (net::InputStatus& status : m_receiver.inputs()) {
        const auto state = std::ranges::find(m_state.ports, std::optional(status.id), &PortState::id);
        if (state != m_state.ports.end()) {
            // Packets come also if a group is joined on some interfaces only: inputState() says it.
            const bool isConnection = state->port.kind == Kind::TcpConnection;
            state->problem = isConnection ? QString::fromStdString(status.problem) : QString();
            state->status = std::move(status);
        }
    }
}

QString Receiving::tryPort(const InputAddress& port) {
    const auto same = std::ranges::find_if(
        m_state.ports, [&](const PortState& state) { return useTheSame(state.port, port); });
    if (same != m_state.ports.end()) {
        return QCoreApplication::translate("Receiving", "%1 is there already.").arg(displayText(same->port));
    }
    m_state.ports.push_back({port, {}});
    open(m_state.ports.back());
    if (m_state.ports.back().id) {
        return {};
    }
    const QString problem = m_state.ports.back().problem;
    m_state.ports.pop_back();
    return problem;
}

QString Receiving::changePort(const InputAddress& from, const InputAddress& to) {
    const auto place = std::ranges::find(m_state.ports, from, &PortState::port);
    if (place == m_state.ports.end()) {
        return tryPort(to);
    }
    if (from == to) {
        return {};
    }
    const auto row = place - m_state.ports.begin();
    removePort(from); // first: the same port may be asked for with other groups
    const QString problem = tryPort(to);
    if (!problem.isEmpty()) {
        addPort(from);
    }
    std::rotate(m_state.ports.begin() + row, m_state.ports.end() - 1, m_state.ports.end());
    return problem;
}

void Receiving::retry() {
    for (PortState& state : m_state.ports) {
        if (!state.id) {
            open(state);
        }
    }
}

void Receiving::listenTo(const QStringList& allowed) {
    m_allowed = allowed;
    qCInfo(inputsLog).noquote() << "listening to"
                                << (allowed.isEmpty() ? QStringLiteral("everyone") : allowed.join(u' '));
    std::vector<std::string> entries;
    std::ranges::transform(allowed, std::back_inserter(entries), &QString::toStdString);
    m_state.allowedProblem.clear();
    m_receiver.listenTo(net::AllowList::withoutNames(entries));
    if (m_lookUp.valid()) {
        m_abandoned.push_back(std::move(m_lookUp));
    }
    if (!entries.empty()) {
        m_lookUp = std::async(std::launch::async, [entries] { return net::AllowList::of(entries); });
    }
}

void Receiving::takeAllowed() {
    std::erase_if(m_abandoned, [](const auto& answer) { return isReady(answer); });
    if (!isReady(m_lookUp)) {
        return;
    }
    if (const auto list = m_lookUp.get()) {
        m_receiver.listenTo(*list);
    } else {
        m_state.allowedProblem = QString::fromStdString(list.error().text);
    }
}

void Receiving::readStage(const stage::StageOptions& options) {
    m_state.stage = QString::fromStdString(options.site);
    m_stage = std::make_unique<stage::StageReader>(
        m_receiver, m_log, m_clock,
        stage::StageChoice{options.servers, options.site, stage::wallTimeOf(options.since)});
}

void Receiving::measure(log::Stamp now) {
    takeAllowed();
    readStatus();
    const net::ReceiveTotals figures = m_receiver.totals();
    m_state.kernelDropped = figures.kernelDropped;
    m_state.kernel = figures.kernel;
    m_state.refusedDatagrams = figures.refusedDatagrams;
    m_state.receiveBufferBytes = figures.receiveBufferBytes;
    m_state.longestDelay = figures.longestDelay;
    std::uint64_t datagrams = figures.datagrams;
    std::uint64_t bytes = figures.bytes;
    if (m_stage != nullptr) {
        m_state.probes = m_stage->probes();
        m_state.stageProblem = QString::fromStdString(m_stage->problem());
        for (const stage::ProbeState& probe : m_state.probes) {
            datagrams += probe.received;
            bytes += probe.receivedBytes;
        }
    }
    const Rates all = m_rates.add(now, datagrams, bytes);
    m_state.datagramsPerSecond = all.datagrams;
    m_state.bytesPerSecond = all.bytes;
    for (PortState& port : m_state.ports) {
        const net::InputStatus& status = port.status;
        port.datagramsPerSecond =
            port.id ? m_portRates[*port.id].add(now, status.datagrams, status.bytes).datagrams : 0;
    }
    m_waysOut.measure(openInputs());
    m_state.waysOut = m_waysOut.states();
}

Receiving::Rates Receiving::RateMeter::add(log::Stamp now, std::uint64_t datagrams, std::uint64_t bytes) {
    m_totals.push_back({now, datagrams, bytes});
    while (m_totals.size() > 2 && m_totals[1].stamp <= now - kRateWindow) {
        m_totals.pop_front();
    }
    const Totals& before = m_totals.front();
    const double seconds = log::secondsOf(now - before.stamp);
    if (seconds > 0) {
        m_rates = {static_cast<double>(datagrams - before.datagrams) / seconds,
                   static_cast<double>(bytes - before.bytes) / seconds};
    }
    return m_rates;
}

std::vector<net::InputStatus> Receiving::openInputs() const {
    std::vector<net::InputStatus> inputs;
    for (const PortState& state : m_state.ports) {
        if (state.id) {
            inputs.push_back(state.status);
        }
    }
    return inputs;
}

void Receiving::examine(const model::SessionView& session, log::Stamp now) {
    if (std::chrono::abs(now - m_examined) < kExamine) {
        return;
    }
    m_examined = now;
    std::vector<net::FailedInput> failed;
    for (const PortState& port : m_state.ports) {
        if (!port.id && !port.problem.isEmpty()) {
            failed.push_back({port.port.kind,
                              endpointOf(port.port),
                              {net::NetError::Kind::Other, port.problem.toStdString()}});
        }
    }
    m_state.findings = m_watch.look(session, openInputs(), std::move(failed), m_state.kernel, now);
    m_state.addresses = m_watch.addresses();
}

InputChoices Receiving::choices() const {
    InputChoices choices{std::vector<InputAddress>{}, {}};
    std::ranges::transform(m_state.ports, std::back_inserter(*choices.inputs), &PortState::port);
    std::ranges::transform(m_waysOut.states(), std::back_inserter(choices.waysOut), &WayOutState::target);
    choices.allowed = m_allowed;
    return choices;
}

net::Endpoint Receiving::openPlace() const {
    const auto open = std::ranges::find_if(
        m_state.ports, [](const PortState& state) { return state.id && state.port.kind == Kind::Udp; });
    if (open == m_state.ports.end()) {
        return {{}, 0};
    }
    net::Endpoint place = endpointOf(open->port);
    if (place.host.empty() || place.host == "0.0.0.0") {
        place.host = "127.0.0.1";
    } else if (place.host == "::") {
        place.host = "::1";
    }
    return place;
}

} // namespace posewire::gui
