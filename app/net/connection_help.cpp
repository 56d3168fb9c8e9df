// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/connection_help.h"

#include "core/log/ip_packet.h"
#include "core/model/session/roster.h"

#include <QHostAddress>
#include <QTcpSocket>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <system_error>
#include <utility>

namespace posewire::net {
namespace {

namespace fs = std::filesystem;

bool hasLine(const fs::path& file, const std::string& wanted) {
    std::ifstream stream(file);
    std::string line;
    while (std::getline(stream, line)) {
        if (line == wanted) {
            return true;
        }
    }
    return false;
}

bool isThere(const fs::path& path) {
    std::error_code fault;
    return fs::exists(fs::symlink_status(path, fault));
}

using Kind = words::Kind;
using words::Fact;
using Findings = std::vector<Fact>;

constexpr log::Duration kSilenceTold = std::chrono::seconds(2);

std::string protocolOf(InputKind kind) {
    return kind == InputKind::Udp ? "UDP" : "TCP";
}

bool has(const ConnectionFacts& facts, InputKind kind) {
    return std::ranges::any_of(facts.inputs, [kind](const InputStatus& input) { return input.kind == kind; });
}

words::NamedValue lasted(log::Duration duration) {
    return {"lasted", static_cast<std::uint64_t>(duration / std::chrono::seconds(1))};
}

/// A multicast group is heard on all.
bool listensOn(const InputStatus& input, const LocalAddress& address) {
    const QHostAddress own(QString::fromStdString(input.endpoint.host));
    return own.isNull() || own.isMulticast() || own == QHostAddress::Any || own == QHostAddress::AnyIPv6 ||
           (own == QHostAddress::AnyIPv4 && address.isIpv4) ||
           own == QHostAddress(QString::fromStdString(address.address));
}

/// "192.168.1.20 (eth0) or 10.0.0.4 (wlan0)"; nothing if there is no such address. Nobody types link-local
/// ones of IPv6 into a sender.
template <class IsMeant>
Fact hostFact(const ConnectionFacts& facts, const IsMeant& isMeant) {
    constexpr std::size_t kMost = 3;
    std::size_t count = 0;
    Fact all;
    for (const LocalAddress& address : facts.addresses) {
        if ((address.isIpv4 || !address.isLinkLocal) && isMeant(address) && count < kMost) {
            const Fact one{Kind::HostOn, {{"address", address.address}, {"name", address.interface}}};
            all = count++ == 0 ? one : Fact{Kind::Either, {{"first", all}, {"second", one}}};
        }
    }
    return all;
}

void findFailed(const ConnectionFacts& facts, Findings& findings) {
    for (const FailedInput& failed : facts.failed) {
        findings.push_back({Kind::CannotOpen, {{"problem", failed.error.text}}});
    }
    if (facts.inputs.empty() && facts.failed.empty()) {
        findings.emplace_back(Kind::NoInput);
    }
}

std::uint64_t refusedIn(const ConnectionFacts& facts) {
    std::uint64_t refused = 0;
    for (const InputStatus& input : facts.inputs) {
        refused += input.refusedDatagrams;
    }
    return refused;
}

Fact problemOf(const InputStatus& input) {
    const QHostAddress own(QString::fromStdString(input.endpoint.host));
    const bool isOfGroups = own.isNull() || own.isMulticast() || !input.groups.empty();
    return {isOfGroups ? Kind::NotJoined : Kind::AddressGone, {{"problem", input.problem}}};
}

void findLeftOut(const ConnectionFacts& facts, Findings& findings) {
    const std::uint64_t refused = refusedIn(facts);
    for (const InputStatus& input : facts.inputs) {
        if (input.kind == InputKind::Udp && !input.problem.empty()) {
            findings.push_back(problemOf(input));
        }
    }
    if (refused != 0 && facts.silence >= kSilenceTold) {
        findings.push_back(words::counted(Kind::NotListenedTo, refused));
    }
}

/// All that one program sends is one finding, even if it uses a new port for each datagram: its newest, with
/// the total count.
void findForeign(const ConnectionFacts& facts, Findings& findings) {
    struct Host {
        std::string host;
        Fact fact;
        std::uint64_t count = 0;
        std::uint64_t ports = 0;
    };
    std::vector<Host> hosts;
    for (const Fact& fact : facts.foreign) {
        const std::string host(log::hostOf(std::get<std::string>(*find(fact, "address"))));
        auto known = std::ranges::find_if(hosts, [&](const Host& other) {
            return other.host == host && *find(other.fact, "looks") == *find(fact, "looks");
        });
        known = known == hosts.end() ? hosts.insert(known, Host{host, fact}) : known;
        known->fact = fact;
        known->count += std::get<std::uint64_t>(*find(fact, "n"));
        ++known->ports;
    }
    for (Host& host : hosts) {
        if (host.ports > 1) {
            set(host.fact, "n", host.count);
            set(host.fact, "address", host.host);
            set(host.fact, "ports", host.ports);
        }
        findings.push_back(std::move(host.fact));
    }
}

void findPeers(const ConnectionFacts& facts, Findings& findings) {
    for (const InputStatus& input : facts.inputs) {
        if (input.state == InputState::Retrying) {
            findings.push_back({Kind::NotReachable, {{"problem", input.text}}});
        }
        for (const Peer& peer : input.peers) {
            if (peer.bytes == 0 && facts.now - peer.connected >= kSilenceTold) {
                findings.push_back(
                    {Kind::SilentPeer, {{"address", peer.address}, lasted(facts.now - peer.connected)}});
            } else if (peer.datagrams == 0 && peer.skippedBytes != 0) {
                findings.push_back(
                    {Kind::GarbledPeer, {{"address", peer.address}, {"n", std::uint64_t{peer.bytes}}}});
            }
        }
    }
}

bool isKnocked(const ConnectionFacts& facts) {
    constexpr std::uint64_t kKnocks = 3;
    return facts.kernel.refusedTcp >= kKnocks && !has(facts, InputKind::TcpListener);
}

/// Reports what the kernel rejects at the rate of a stream.
void findElsewhere(const ConnectionFacts& facts, const std::string& port, Findings& findings) {
    constexpr std::uint64_t kMany = 10;
    const auto seconds = static_cast<std::uint64_t>(facts.silence / std::chrono::seconds(1));
    if (facts.kernel.noPort >= std::max(kMany, 2 * seconds)) {
        findings.push_back({Kind::NoListener, {{"n", facts.kernel.noPort}, {"port", port}}});
    }
    if (!facts.knocker.empty()) {
        findings.push_back({Kind::TcpKnocked, {{"address", facts.knocker}, {"port", port}}});
    } else if (isKnocked(facts)) {
        findings.push_back({Kind::TcpRefused, {{"n", facts.kernel.refusedTcp}}});
    }
}

void findSilence(const ConnectionFacts& facts, Findings& findings) {
    const bool listens = has(facts, InputKind::Udp) || has(facts, InputKind::TcpListener);
    if (!listens || facts.silence < kSilenceTold) {
        return;
    }
    if (facts.datagrams != 0) {
        findings.push_back({Kind::WentSilent, {lasted(facts.silence)}});
        return;
    }
    if (refusedIn(facts) != 0) {
        return; // something does arrive
    }
    const auto open = std::ranges::find_if(
        facts.inputs, [](const InputStatus& input) { return input.kind != InputKind::TcpConnection; });
    const std::string port = std::to_string(open->endpoint.port);
    const Fact heard = hostFact(facts, [&](const auto& address) { return listensOn(*open, address); });
    const words::Value host =
        heard.isNothing() && !open->endpoint.host.empty() ? words::Value(open->endpoint.host) : heard;
    findings.push_back(
        {Kind::NothingArrives, {{"protocol", protocolOf(open->kind)}, {"port", port}, {"host", host}}});
    if (const Fact others =
            hostFact(facts,
                     [&](const auto& one) {
                         return std::ranges::none_of(facts.inputs, [&](const InputStatus& input) {
                             return input.kind != InputKind::TcpConnection && listensOn(input, one);
                         });
                     });
        !others.isNothing()) {
        findings.push_back({Kind::ListensOnly, {{"host", host}, {"others", others}}});
    }
    findElsewhere(facts, port, findings);
}

/// Data sent by a transport that no input uses is invisible here, so say so.
void findTransport(const ConnectionFacts& facts, Findings& findings) {
    const bool hasUdp = has(facts, InputKind::Udp);
    const bool hasTcp = has(facts, InputKind::TcpListener);
    if (facts.datagrams != 0 || facts.silence < kSilenceTold || hasUdp == hasTcp) {
        return;
    }
    const auto of = [](bool isUdp) { return protocolOf(isUdp ? InputKind::Udp : InputKind::TcpListener); };
    findings.push_back({Kind::OtherTransport, {{"protocol", of(hasUdp)}, {"other", of(!hasUdp)}}});
}

void findBlocked(const ConnectionFacts& facts, Findings& findings) {
    if (!facts.firewall || facts.datagrams != 0 || facts.silence < kSilenceTold || facts.inputs.empty()) {
        return;
    }
    const InputStatus& input = facts.inputs.front();
    std::string command = facts.firewall->command;
    const std::string port = std::to_string(input.endpoint.port);
    if (const auto place = command.find("PORT"); place != std::string::npos) {
        command.replace(place, 4, port);
    }
    if (const auto place = command.find("udp"); input.kind != InputKind::Udp && place != std::string::npos) {
        command.replace(place, 3, "tcp");
    }
    findings.push_back({Kind::FirewallOn,
                        {{"name", facts.firewall->name},
                         {"command", command},
                         {"protocol", protocolOf(input.kind)},
                         {"port", port}}});
}

} // namespace

std::optional<Firewall> findFirewall(const std::string& root) {
    const fs::path base(root);
    if (hasLine(base / "etc/ufw/ufw.conf", "ENABLED=yes")) {
        return Firewall{"ufw", "sudo ufw allow PORT/udp"};
    }
    if (isThere(base / "run/firewalld.pid") || isThere(base / "run/firewalld")) {
        return Firewall{"firewalld", "sudo firewall-cmd --add-port=PORT/udp"};
    }
    if (isThere(base / "etc/systemd/system/sysinit.target.wants/nftables.service")) {
        return Firewall{"nftables", ""};
    }
    if (hasLine(base / "proc/net/ip_tables_names", "filter")) {
        return Firewall{"iptables", "sudo iptables -I INPUT -p udp --dport PORT -j ACCEPT"};
    }
    return std::nullopt;
}

#ifndef _WIN32
std::optional<Firewall> findFirewall() {
    return findFirewall("/");
}
#endif

std::vector<Fact> connectionHelp(const ConnectionFacts& facts) {
    Findings findings;
    for (const auto find :
         {findFailed, findLeftOut, findForeign, findPeers, findSilence, findTransport, findBlocked}) {
        find(facts, findings);
    }
    return findings;
}

std::vector<Fact> ConnectionWatch::look(const model::SessionView& session, std::vector<InputStatus> inputs,
                                        std::vector<FailedInput> failed, const log::KernelCounters& kernel,
                                        log::Stamp now) {
    constexpr log::Duration kAsk = std::chrono::seconds(3);
    if (m_asked == log::Stamp() || std::chrono::abs(now - m_asked) >= kAsk) {
        m_asked = now;
        m_addresses = reachable(localAddresses());
        m_firewall = findFirewall();
    }
    std::vector<InputId> open;
    std::ranges::transform(inputs, std::back_inserter(open), &InputStatus::id);
    if (open != m_open || m_opened == log::Stamp()) {
        m_open = std::move(open);
        m_opened = now;
        m_kernel = kernel;
    }
    ConnectionFacts facts;
    facts.inputs = std::move(inputs);
    facts.failed = std::move(failed);
    facts.addresses = m_addresses;
    facts.firewall = m_firewall;
    facts.now = now;
    log::Stamp newest = m_opened;
    for (const model::Sender& sender : session.roster().senders()) {
        const bool isFromNetwork =
            sender.info.transport == log::Transport::Udp || sender.info.transport == log::Transport::Tcp;
        if (isFromNetwork && sender.datagrams != 0) {
            facts.datagrams += sender.datagrams;
            newest = std::max(newest, sender.lastStamp);
        }
        if (isFromNetwork && sender.foreign != 0) {
            facts.foreign.push_back(sender.foreignFact());
        }
    }
    facts.silence = std::max(log::Duration::zero(), now - newest);
    m_kernel = facts.datagrams != 0 && facts.silence < kSilenceTold ? kernel : m_kernel;
    facts.kernel = kernel.since(m_kernel);
    answerKnocks(facts);
    return connectionHelp(facts);
}

/// Listens for TCP on a port of UDP for as long as this computer refuses connections and nothing else comes:
/// whoever connects is named.
void ConnectionWatch::answerKnocks(ConnectionFacts& facts) {
    const auto udp = std::ranges::find(facts.inputs, InputKind::Udp, &InputStatus::kind);
    if (facts.silence < kSilenceTold || !isKnocked(facts) || udp == facts.inputs.end()) {
        m_door.close();
        m_knocker.clear();
        return;
    }
    if (m_knocker.empty() && !m_door.isListening()) {
        m_door.listen(QHostAddress::Any, udp->endpoint.port);
    }
    while (m_door.isListening() && m_door.waitForNewConnection(0)) {
        const std::unique_ptr<QTcpSocket> peer(m_door.nextPendingConnection());
        const QHostAddress address = peer->peerAddress();
        bool isIpv4 = false;
        const QHostAddress mapped(address.toIPv4Address(&isIpv4));
        m_knocker = (isIpv4 ? mapped : address).toString().toStdString();
        m_door.close();
    }
    facts.knocker = m_knocker;
}

} // namespace posewire::net
