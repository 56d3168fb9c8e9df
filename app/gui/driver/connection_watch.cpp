// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/connection_watch.h"

#include "core/log/time.h"

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr log::Duration kExamine = std::chrono::milliseconds(250);
constexpr log::Duration kAsk = std::chrono::seconds(3);

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
                                     log::Stamp opened, log::Stamp now) {
    net::ConnectionFacts facts;
    facts.now = now;
    for (const PortState& port : state.ports) {
        if (port.id) {
            facts.inputs.push_back(port.status);
        } else if (!port.problem.isEmpty()) {
            facts.failed.push_back({kindOf(port.port.kind),
                                    {port.port.address.toStdString(), port.port.port},
                                    {net::NetError::Kind::Other, port.problem.toStdString()}});
        }
    }
    log::Stamp newest = opened;
    for (const model::Sender& sender : session.senders()) {
        if (!isFromNetwork(sender)) {
            continue;
        }
        facts.mxtpDatagrams += sender.datagrams + sender.malformed;
        if (sender.datagrams + sender.malformed != 0) {
            newest = std::max(newest, sender.lastStamp);
        }
        if (sender.foreign != 0) {
            facts.foreign.push_back({sender.info.address, sender.foreign, sender.foreignHead});
        }
    }
    facts.silence = std::max(log::Duration::zero(), now - newest);
    return facts;
}

void ConnectionWatch::examine(const model::SessionView& session, log::Stamp now, ReceivingState& state) {
    if (std::chrono::abs(now - m_examined) < kExamine) {
        return;
    }
    m_examined = now;
    askSystem(now);
    noteOpenings(now, state);
    net::ConnectionFacts facts = connectionFacts(session, state, m_opened, now);
    facts.addresses = m_addresses;
    facts.firewall = m_firewall;
    state.findings = net::connectionHelp(facts);
    state.addresses = m_addresses;
}

void ConnectionWatch::askSystem(log::Stamp now) {
    if (std::chrono::abs(now - m_asked) >= kAsk) {
        m_asked = now;
        m_addresses = net::reachable(net::localAddresses());
        m_firewall = net::findFirewall();
    }
}

void ConnectionWatch::noteOpenings(log::Stamp now, const ReceivingState& state) {
    std::vector<net::InputId> open;
    for (const PortState& port : state.ports) {
        if (port.id) {
            open.push_back(*port.id);
        }
    }
    if (open != m_open || m_opened == log::Stamp()) {
        m_open = open;
        m_opened = now;
    }
}

} // namespace posewire::gui
