// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/connection_help.h"

#include "core/log/ip_packet.h"
#include "core/model/text.h"
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

using Kind = Finding::Kind;
using Findings = std::vector<Finding>;

constexpr log::Duration kSilenceTold = std::chrono::seconds(2);
constexpr std::string_view kWhereInMvn = "In MVN: Options > Preferences > Network Streamer";

const char* protocolOf(InputKind kind) {
    return kind == InputKind::Udp ? "UDP" : "TCP";
}

bool has(const ConnectionFacts& facts, InputKind kind) {
    return std::ranges::any_of(facts.inputs, [kind](const InputStatus& input) { return input.kind == kind; });
}

std::string secondsText(log::Duration duration) {
    return std::to_string(duration / std::chrono::seconds(1)) + " s";
}

/// "12 345", with narrow spaces.
std::string grouped(std::uint64_t number) {
    return model::grouped(number);
}

/// "192.168.1.20 (eth0) or 10.0.0.4 (wlan0)".
std::string addressesText(const ConnectionFacts& facts) {
    constexpr std::size_t kMost = 3;
    std::string text;
    for (std::size_t i = 0; i < std::min(facts.addresses.size(), kMost); ++i) {
        const LocalAddress& address = facts.addresses[i];
        text += (i == 0 ? "" : " or ") + address.address + " (" + address.interface + ")";
    }
    return text.empty() ? "the address of this computer" : text;
}

void findFailed(const ConnectionFacts& facts, Findings& findings) {
    for (const FailedInput& failed : facts.failed) {
        const std::size_t cut = failed.error.text.rfind("; ");
        const bool hasAdvice = cut != std::string::npos;
        findings.push_back({Kind::CannotOpen, failed.error.text.substr(0, cut),
                            hasAdvice ? failed.error.text.substr(cut + 2) : "choose another port"});
    }
    if (facts.inputs.empty() && facts.failed.empty()) {
        findings.push_back({Kind::NoInput, "no port is open", "add UDP port 9763, MVN's default"});
    }
}

std::uint64_t refusedIn(const ConnectionFacts& facts) {
    std::uint64_t refused = 0;
    for (const InputStatus& input : facts.inputs) {
        refused += input.refusedDatagrams;
    }
    return refused;
}

/// What is wrong with an input that is open, in a text that has the remedy as well if it is its own
/// address.
Finding findingOf(const InputStatus& input) {
    const QHostAddress own(QString::fromStdString(input.endpoint.host));
    const std::size_t end = input.problem.find("; ");
    if (own.isNull() || own.isMulticast() || end == std::string::npos) {
        return {Kind::NotJoined, input.problem,
                "check that the network is connected; it is tried again whenever it changes"};
    }
    return {Kind::AddressGone, input.problem.substr(0, end), input.problem.substr(end + 2)};
}

void findLeftOut(const ConnectionFacts& facts, Findings& findings) {
    const std::uint64_t refused = refusedIn(facts);
    for (const InputStatus& input : facts.inputs) {
        if (input.kind == InputKind::Udp && !input.problem.empty()) {
            findings.push_back(findingOf(input));
        }
    }
    if (refused != 0 && facts.silence >= kSilenceTold) {
        findings.push_back({Kind::NotListenedTo,
                            grouped(refused) + (refused == 1 ? " datagram has" : " datagrams have") +
                                " arrived from hosts that are not listened to",
                            "add the sender's address under Listen only to, or leave that empty"});
    }
}

/// All that one program sends, even if it uses a new port for each datagram.
struct ForeignHost {
    std::string host;
    std::string guess;
    ForeignSender sender; ///< the newest one, with the total count
    std::size_t ports = 1;
};

std::vector<ForeignHost> foreignHosts(const std::vector<ForeignSender>& senders) {
    std::vector<ForeignHost> hosts;
    for (const ForeignSender& sender : senders) {
        const std::string host(log::hostOf(sender.address));
        const std::string guess = protocolThatBegins(sender.firstBytes);
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
        const bool isOne = sender.count == 1;
        const std::string from =
            ports == 1 ? sender.address : host + " (" + std::to_string(ports) + " ports)";
        std::string text = grouped(sender.count) + (isOne ? " datagram" : " datagrams") + " from " + from +
                           (isOne ? " is not MXTP; it" : " are not MXTP; the newest") + " begins with " +
                           shownBytes(sender.firstBytes);
        text += guess.empty() ? "" : ", which looks like " + guess;
        findings.push_back({Kind::NotMxtp, text,
                            "another program sends to this port: stop it, or have MVN send to another port "
                            "and listen there"});
    }
}

void findPeers(const ConnectionFacts& facts, Findings& findings) {
    for (const InputStatus& input : facts.inputs) {
        if (input.state == InputState::Retrying) {
            findings.push_back({Kind::NotReachable, input.text,
                                "check host and port, and that the sender listens; MVN itself does not "
                                "listen but connects: for MVN, listen on a TCP port here"});
        }
        for (const Peer& peer : input.peers) {
            if (peer.bytes == 0 && facts.now - peer.connected >= kSilenceTold) {
                findings.push_back(
                    {Kind::SilentPeer,
                     peer.address + " is connected by TCP and has sent nothing for " +
                         secondsText(facts.now - peer.connected),
                     std::string(kWhereInMvn) +
                         ", switch on datagrams to send, and press play or switch on Send Paused"});
            } else if (peer.datagrams == 0 && peer.skippedBytes != 0) {
                findings.push_back({Kind::GarbledPeer,
                                    peer.address + " is connected by TCP, and none of its " +
                                        grouped(peer.bytes) + " bytes are MXTP",
                                    "another program has connected to this port: stop it, or listen on "
                                    "another port"});
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
        findings.push_back(
            {Kind::WentSilent, "no data for " + secondsText(facts.silence),
             "check that MVN is playing and streaming: while paused it sends only with Send Paused on"});
        return;
    }
    if (refusedIn(facts) != 0) {
        return; // something does arrive
    }
    const auto open = std::ranges::find_if(
        facts.inputs, [](const InputStatus& input) { return input.kind != InputKind::TcpConnection; });
    findings.push_back({Kind::NothingArrives,
                        std::string("nothing has arrived on ") + protocolOf(open->kind) + " port " +
                            std::to_string(open->endpoint.port),
                        std::string(kWhereInMvn) + ", host " + addressesText(facts) + ", port " +
                            std::to_string(open->endpoint.port) + ", protocol " + protocolOf(open->kind)});
}

/// Data sent by a transport that no input uses is invisible here, so say so.
void findTransport(const ConnectionFacts& facts, Findings& findings) {
    const bool hasUdp = has(facts, InputKind::Udp);
    const bool hasTcp = has(facts, InputKind::TcpListener);
    if (facts.mxtpDatagrams != 0 || facts.silence < kSilenceTold || hasUdp == hasTcp) {
        return;
    }
    const char* other = hasUdp ? "TCP" : "UDP";
    findings.push_back(
        {Kind::OtherTransport,
         std::string("only ") + (hasUdp ? "UDP" : "TCP") + " inputs are open; a sender that uses " + other +
             " would go unnoticed",
         std::string("check Protocol in MVN's Network Streamer, or listen for ") + other + " as well"});
}

void findBlocked(const ConnectionFacts& facts, Findings& findings) {
    if (!facts.firewall || facts.mxtpDatagrams != 0 || facts.silence < kSilenceTold || facts.inputs.empty()) {
        return;
    }
    const InputStatus& input = facts.inputs.front();
    std::string remedy = facts.firewall->remedy;
    if (const auto place = remedy.find("PORT"); place != std::string::npos) {
        remedy.replace(place, 4, std::to_string(input.endpoint.port));
    }
    const auto protocol = remedy.find("udp");
    if (input.kind != InputKind::Udp && protocol != std::string::npos) {
        remedy.replace(protocol, 3, "tcp");
    }
    findings.push_back(
        {Kind::FirewallOn,
         "a firewall (" + facts.firewall->name +
             ") is active on this computer and may block datagrams; Posewire cannot read its rules",
         remedy});
}

} // namespace

std::string protocolThatBegins(Bytes bytes) {
    struct Beginning {
        std::string_view text;
        std::string_view name;
    };
    constexpr std::array kBeginnings{Beginning{"Art-Net", "Art-Net (lighting)"},
                                     Beginning{"GET ", "HTTP (a web browser)"},
                                     Beginning{"POST ", "HTTP (a web browser)"},
                                     Beginning{"fr ", "ART DTrack"},
                                     Beginning{"{", "JSON text (Rokoko, or MVN's own remote control)"},
                                     Beginning{"<", "XML text (MVN's own remote control, or a web page)"}};
    const std::string_view text = charactersOf(bytes);
    if (const auto mark = text.find("MXTP"); mark != std::string_view::npos && mark != 0) {
        return "MXTP behind " + std::to_string(mark) + " other bytes (a tunnel, or a length prefix)";
    }
    for (const Beginning& beginning : kBeginnings) {
        if (text.starts_with(beginning.text)) {
            return std::string(beginning.name);
        }
    }
    if (isOsc(bytes)) {
        return "OSC";
    }
    if (isNatNet(bytes)) {
        return "NatNet (OptiTrack Motive)";
    }
    if (isVicon(bytes)) {
        return "Vicon's object stream";
    }
    return isQualisys(bytes) ? "Qualisys QTM's real-time protocol" : std::string();
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
        return Firewall{"nftables", "ask the administrator to accept PORT/udp in /etc/nftables.conf"};
    }
    if (hasLine(base / "proc/net/ip_tables_names", "filter")) {
        return Firewall{"iptables", "sudo iptables -I INPUT -p udp --dport PORT -j ACCEPT"};
    }
    return std::nullopt;
}

std::vector<Finding> connectionHelp(const ConnectionFacts& facts) {
    Findings findings;
    for (const auto find :
         {findFailed, findLeftOut, findForeign, findPeers, findSilence, findTransport, findBlocked}) {
        find(facts, findings);
    }
    return findings;
}

} // namespace posewire::net
