// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/connection_help.h"

#include "core/log/ip_packet.h"
#include "core/wire/text.h"

#include <QHostAddress>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

namespace posewire::net {
namespace {

using Bytes = std::span<const std::byte>;

unsigned at(Bytes bytes, std::size_t index) {
    return index < bytes.size() ? std::to_integer<unsigned>(bytes[index]) : 0U;
}

unsigned littleEndian16(Bytes bytes, std::size_t index) {
    return at(bytes, index) | at(bytes, index + 1) << 8;
}

std::string_view charactersOf(Bytes bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// An address such as "/body/hip" that ends with a zero, padded to four bytes.
bool isOsc(Bytes bytes) {
    const std::string_view text = charactersOf(bytes);
    return text.starts_with("#bundle") ||
           (text.starts_with('/') && bytes.size() >= 4 && std::ranges::all_of(text.substr(1, 3), [](char c) {
                return c == '\0' || (c >= ' ' && c <= '~');
            }));
}

/// A message number and the size of what follows, both little-endian; frames are 7, descriptions 5.
bool isNatNet(Bytes bytes) {
    const unsigned message = littleEndian16(bytes, 0);
    return bytes.size() >= 4 && (message == 5 || message == 7) && littleEndian16(bytes, 2) != 0;
}

/// Frame number, count of items, then the first item: number 0 and 72 bytes.
bool isVicon(Bytes bytes) {
    return bytes.size() >= 8 && at(bytes, 4) != 0 && at(bytes, 5) == 0 && littleEndian16(bytes, 6) == 72;
}

/// A packet's size, big-endian, and its kind, one of a few.
bool isQualisys(Bytes bytes) {
    return bytes.size() >= 8 && at(bytes, 0) == 0 && at(bytes, 1) == 0 && at(bytes, 4) == 0 &&
           at(bytes, 5) == 0 && at(bytes, 6) == 0 && at(bytes, 7) <= 9 && at(bytes, 2) + at(bytes, 3) != 0;
}

/// "4d 58 54 50  MXTP", at most 16 bytes, with dots for unprintable ones.
std::string shownBytes(Bytes bytes) {
    constexpr std::size_t kShown = 16;
    std::string hexadecimal;
    std::string readable;
    for (const std::byte& byte : bytes.first(std::min(bytes.size(), kShown))) {
        const auto value = std::to_integer<unsigned char>(byte);
        hexadecimal += wire::hexadecimal({&byte, 1}) + ' ';
        readable += value >= ' ' && value <= '~' ? static_cast<char>(value) : '.';
    }
    return hexadecimal + ' ' + readable;
}

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

/// "192.168.1.20 (eth0) or 10.0.0.4 (wlan0)"; nothing if there is no address.
Fact hostFact(const ConnectionFacts& facts) {
    constexpr std::size_t kMost = 3;
    Fact all;
    for (std::size_t i = 0; i < std::min(facts.addresses.size(), kMost); ++i) {
        const LocalAddress& address = facts.addresses[i];
        const Fact one{Kind::HostOn, {{"address", address.address}, {"name", address.interface}}};
        all = i == 0 ? one : Fact{Kind::Either, {{"first", all}, {"second", one}}};
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

/// All that one program sends, even if it uses a new port for each datagram.
struct ForeignHost {
    std::string host;
    Fact guess;
    ForeignSender sender; ///< the newest one, with the total count
    std::size_t ports = 1;
};

std::vector<ForeignHost> foreignHosts(const std::vector<ForeignSender>& senders) {
    std::vector<ForeignHost> hosts;
    for (const ForeignSender& sender : senders) {
        const std::string host(log::hostOf(sender.address));
        const Fact guess = protocolThatBegins(sender.firstBytes);
        const auto known = std::ranges::find_if(
            hosts, [&](const ForeignHost& other) { return other.host == host && other.guess == guess; });
        if (known == hosts.end()) {
            hosts.push_back({host, guess, sender});
        } else {
            const std::uint64_t before = known->sender.count;
            known->sender = sender;
            known->sender.count += before;
            ++known->ports;
        }
    }
    return hosts;
}

void findForeign(const ConnectionFacts& facts, Findings& findings) {
    for (const auto& [host, guess, sender, ports] : foreignHosts(facts.foreign)) {
        Fact fact{Kind::ForeignDatagrams,
                  {{"n", sender.count},
                   {"address", ports == 1 ? sender.address : host},
                   {"value", shownBytes(sender.firstBytes)},
                   {"looks", guess}}};
        if (ports > 1) {
            words::set(fact, "ports", std::uint64_t{ports});
        }
        findings.push_back(std::move(fact));
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

void findSilence(const ConnectionFacts& facts, Findings& findings) {
    const bool listens = has(facts, InputKind::Udp) || has(facts, InputKind::TcpListener);
    if (!listens || facts.silence < kSilenceTold) {
        return;
    }
    if (facts.mxtpDatagrams != 0) {
        findings.push_back({Kind::WentSilent, {lasted(facts.silence)}});
        return;
    }
    if (refusedIn(facts) != 0) {
        return; // something does arrive
    }
    const auto open = std::ranges::find_if(
        facts.inputs, [](const InputStatus& input) { return input.kind != InputKind::TcpConnection; });
    findings.push_back({Kind::NothingArrives,
                        {{"protocol", protocolOf(open->kind)},
                         {"port", std::to_string(open->endpoint.port)},
                         {"host", hostFact(facts)}}});
}

/// Data sent by a transport that no input uses is invisible here, so say so.
void findTransport(const ConnectionFacts& facts, Findings& findings) {
    const bool hasUdp = has(facts, InputKind::Udp);
    const bool hasTcp = has(facts, InputKind::TcpListener);
    if (facts.mxtpDatagrams != 0 || facts.silence < kSilenceTold || hasUdp == hasTcp) {
        return;
    }
    const auto of = [](bool isUdp) { return protocolOf(isUdp ? InputKind::Udp : InputKind::TcpListener); };
    findings.push_back({Kind::OtherTransport, {{"protocol", of(hasUdp)}, {"other", of(!hasUdp)}}});
}

void findBlocked(const ConnectionFacts& facts, Findings& findings) {
    if (!facts.firewall || facts.mxtpDatagrams != 0 || facts.silence < kSilenceTold || facts.inputs.empty()) {
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

Fact protocolThatBegins(Bytes bytes) {
    struct Beginning {
        std::string_view text;
        Kind kind;
    };
    constexpr std::array kBeginnings{
        Beginning{"Art-Net", Kind::LooksLikeArtNet}, Beginning{"GET ", Kind::LooksLikeHttp},
        Beginning{"POST ", Kind::LooksLikeHttp},     Beginning{"fr ", Kind::LooksLikeDTrack},
        Beginning{"{", Kind::LooksLikeJson},         Beginning{"<", Kind::LooksLikeXml}};
    const std::string_view text = charactersOf(bytes);
    if (const auto mark = text.find("MXTP"); mark != std::string_view::npos && mark != 0) {
        return words::counted(Kind::MxtpBehind, mark);
    }
    for (const Beginning& beginning : kBeginnings) {
        if (text.starts_with(beginning.text)) {
            return beginning.kind;
        }
    }
    return isOsc(bytes)        ? Kind::LooksLikeOsc
           : isNatNet(bytes)   ? Kind::LooksLikeNatNet
           : isVicon(bytes)    ? Kind::LooksLikeVicon
           : isQualisys(bytes) ? Kind::LooksLikeQualisys
                               : Kind::Nothing;
}

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

std::vector<Fact> connectionHelp(const ConnectionFacts& facts) {
    Findings findings;
    for (const auto find :
         {findFailed, findLeftOut, findForeign, findPeers, findSilence, findTransport, findBlocked}) {
        find(facts, findings);
    }
    return findings;
}

} // namespace posewire::net
