// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/connection_watch.h"

#include "core/log/time.h"

#include <algorithm>
#include <cstdlib>

namespace posewire::gui {

namespace {

constexpr std::int64_t kExamineNs = 250 * log::kMillisecondNs;
constexpr std::int64_t kAskNs = 3 * log::kSecondNs;

net::InputKind kindOf(InputAddress::Kind kind) {
    switch (kind) {
    case InputAddress::Kind::Udp:
        return net::InputKind::Udp;
    case InputAddress::Kind::TcpListen:
        return net::InputKind::TcpListener;
    case InputAddress::Kind::TcpConnect:
        break;
    }
    return net::InputKind::TcpConnection;
}

bool isFromNetwork(const model::Sender& sender) {
    return sender.info.transport == log::Transport::Udp || sender.info.transport == log::Transport::Tcp;
}

} // namespace

net::ConnectionFacts connectionFacts(const model::SessionView& session, const ReceivingState& state,
                                     std::int64_t openedNs, std::int64_t nowNs) {
    net::ConnectionFacts facts;
    facts.nowNs = nowNs;
    for (const PortState& port : state.ports) {
        if (port.id) {
            facts.inputs.push_back(port.status);
        } else if (!port.problem.isEmpty()) {
            facts.failed.push_back({kindOf(port.port.kind),
                                    {port.port.address.toStdString(), port.port.port},
                                    {net::NetError::Kind::Other, port.problem.toStdString()}});
        }
    }
    std::int64_t newestNs = openedNs;
    for (const model::Sender& sender : session.senders()) {
        if (!isFromNetwork(sender)) {
            continue;
        }
        facts.mxtpDatagrams += sender.datagrams + sender.malformed;
        if (sender.datagrams + sender.malformed != 0) {
            newestNs = std::max(newestNs, sender.lastStampNs);
        }
        if (sender.foreign != 0) {
            facts.foreign.push_back({sender.info.address, sender.foreign, sender.foreignHead});
        }
    }
    facts.silenceNs = std::max<std::int64_t>(0, nowNs - newestNs);
    return facts;
}

void ConnectionWatch::examine(const model::SessionView& session, std::int64_t nowNs, ReceivingState& state) {
    if (std::abs(nowNs - m_examinedNs) < kExamineNs) {
        return;
    }
    m_examinedNs = nowNs;
    askSystem(nowNs);
    noteOpenings(nowNs, state);
    net::ConnectionFacts facts = connectionFacts(session, state, m_openedNs, nowNs);
    facts.addresses = m_addresses;
    facts.firewall = m_firewall;
    state.findings = net::connectionHelp(facts);
    state.addresses = m_addresses;
}

void ConnectionWatch::askSystem(std::int64_t nowNs) {
    if (std::abs(nowNs - m_askedNs) >= kAskNs) {
        m_askedNs = nowNs;
        m_addresses = net::reachable(net::localAddresses());
        m_firewall = net::findFirewall();
    }
}

void ConnectionWatch::noteOpenings(std::int64_t nowNs, const ReceivingState& state) {
    std::vector<net::InputId> open;
    for (const PortState& port : state.ports) {
        if (port.id) {
            open.push_back(*port.id);
        }
    }
    if (open != m_open || m_openedNs == 0) {
        m_open = open;
        m_openedNs = nowNs;
    }
}

} // namespace posewire::gui
