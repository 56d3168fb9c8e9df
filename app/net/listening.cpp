// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/listening.h"

#include <QVariant>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>
#include <vector>

namespace posewire::net {
namespace {

/// Who holds a port, where that is not known.
constexpr std::string_view kByAnother = "by another program";

using Kind = NetError::Kind;
namespace fs = std::filesystem;

/// Targets of the links in /proc/PID/fd that belong to sockets that listen on the port, from one of the
/// kernel's tables.
void collectSockets(const std::string& table, std::string_view state, std::uint16_t port,
                    std::vector<std::string>& sockets) {
    std::ifstream file(table);
    std::string line;
    std::getline(file, line); // the headings
    while (std::getline(file, line)) {
        std::istringstream columns(line);
        std::string slot, local, remote, stateNow, skipped, inode;
        columns >> slot >> local >> remote >> stateNow;
        for (int i = 0; i < 5; ++i) {
            columns >> skipped; // queues, timer, retransmits, user, timeout
        }
        columns >> inode;
        const std::size_t colon = local.rfind(':');
        if (columns && stateNow == state && colon != std::string::npos &&
            std::strtoul(local.c_str() + colon + 1, nullptr, 16) == port) {
            sockets.push_back("socket:[" + inode + "]");
        }
    }
}

bool holdsAnyOf(const fs::path& process, const std::vector<std::string>& sockets) {
    std::error_code denied;
    for (fs::directory_iterator entry(process / "fd", denied), end; !denied && entry != end;
         entry.increment(denied)) {
        std::error_code vanished;
        const std::string target = fs::read_symlink(entry->path(), vanished).string();
        if (!vanished && std::ranges::find(sockets, target) != sockets.end()) {
            return true;
        }
    }
    return false;
}

NetResult<std::unique_ptr<QUdpSocket>> bindOne(const QHostAddress& address, const Endpoint& endpoint,
                                               int bufferBytes) {
    auto socket = std::make_unique<QUdpSocket>();
    if (!socket->bind(address, endpoint.port, QUdpSocket::DontShareAddress)) {
        return tl::unexpected(listenError("UDP", endpoint, socket->error(), socket->errorString()));
    }
    socket->setSocketOption(QAbstractSocket::ReceiveBufferSizeSocketOption, bufferBytes);
    return socket;
}

NetResult<std::vector<QHostAddress>> groupsOf(const std::vector<std::string>& texts) {
    std::vector<QHostAddress> groups;
    for (const std::string& text : texts) {
        const QHostAddress group(QString::fromStdString(text));
        if (!group.isMulticast()) {
            return netError(Kind::BadEndpoint, "\"" + text +
                                                   "\" is not a multicast group; those are 224.0.0.0 to "
                                                   "239.255.255.255 and addresses that begin with ff");
        }
        groups.push_back(group);
    }
    return groups;
}

NetResult<UdpSockets> bindGroups(Endpoint endpoint, const std::vector<QHostAddress>& groups,
                                 int bufferBytes) {
    using Protocol = QAbstractSocket::NetworkLayerProtocol;
    UdpSockets sockets;
    for (const Protocol protocol : {Protocol::IPv4Protocol, Protocol::IPv6Protocol}) {
        const bool isIpv4 = protocol == Protocol::IPv4Protocol;
        const bool isAskedFor = std::ranges::find(groups, protocol, &QHostAddress::protocol) != groups.end();
        auto socket = bindOne(isIpv4 ? QHostAddress::AnyIPv4 : QHostAddress::AnyIPv6, endpoint, bufferBytes);
        if (!socket) {
            if (isAskedFor || socket.error().kind == Kind::PortInUse) {
                return tl::unexpected(socket.error());
            }
            continue; // a computer without IPv6
        }
        endpoint.port = (*socket)->localPort();
        UdpSocket bound{std::move(*socket), {}};
        std::ranges::copy_if(groups, std::back_inserter(bound.groups),
                             [&](const QHostAddress& group) { return group.protocol() == protocol; });
        sockets.push_back(std::move(bound));
    }
    return sockets;
}

NetResult<UdpSockets> bindAll(const Endpoint& endpoint, const std::vector<std::string>& groupTexts,
                              int bufferBytes) {
    const auto address = listenAddress(endpoint.host);
    if (!address) {
        return tl::unexpected(address.error());
    }
    auto groups = groupsOf(groupTexts);
    if (!groups) {
        return tl::unexpected(groups.error());
    }
    if (address->isMulticast()) {
        groups->push_back(*address);
        return bindGroups({{}, endpoint.port}, *groups, bufferBytes);
    }
    if (!groups->empty() && !endpoint.host.empty()) {
        return netError(Kind::BadEndpoint,
                        "a port of " + endpoint.host +
                            " alone receives no multicast; leave the address out to join a group");
    }
    if (!groups->empty()) {
        return bindGroups(endpoint, *groups, bufferBytes);
    }
    auto socket = bindOne(*address, endpoint, bufferBytes);
    if (!socket) {
        return tl::unexpected(socket.error());
    }
    UdpSockets sockets;
    sockets.push_back({std::move(*socket), {}});
    return sockets;
}

/// The granted receive buffer in the bytes that were requested: Linux adds its own overhead and reports
/// double.
int receiveBufferBytes(QUdpSocket& socket) {
    const int bytes = socket.socketOption(QAbstractSocket::ReceiveBufferSizeSocketOption).toInt();
#ifdef __linux__
    return bytes / 2;
#else
    return bytes;
#endif
}

} // namespace

NetResult<QHostAddress> listenAddress(const std::string& host) {
    const QHostAddress address =
        host.empty() ? QHostAddress(QHostAddress::Any) : QHostAddress(QString::fromStdString(host));
    if (address.isNull()) {
        return netError(Kind::BadEndpoint,
                        "\"" + host + "\" is not an IP address to listen on; write one, or leave it out");
    }
    return address;
}

NetError listenError(const std::string& protocol, const Endpoint& endpoint,
                     QAbstractSocket::SocketError error, const QString& systemText) {
    const std::string port = protocol + " port " + std::to_string(endpoint.port) +
                             (endpoint.host.empty() ? std::string() : " of " + endpoint.host);
    switch (error) {
    case QAbstractSocket::AddressInUseError:
        return {Kind::PortInUse, port + " is in use " + std::string(kByAnother) +
                                     "; close that program or choose another port"};
    case QAbstractSocket::SocketAccessError:
        return {Kind::NoPermission, port + " needs administrator rights; choose a port from 1024 up"};
    case QAbstractSocket::SocketAddressNotAvailableError:
        return {Kind::AddressNotHere, endpoint.host + " is not an address of this computer; leave it out to "
                                                      "listen on all addresses"};
    default:
        return {Kind::Other, "cannot listen on " + port + ": " + systemText.toStdString() +
                                 "; choose another port or address"};
    }
}

std::optional<Process> holderOfPort(std::uint16_t port, bool isTcp) {
    // States in the kernel's tables; a UDP socket without a peer is listed as closed.
    constexpr std::string_view udpUnconnected = "07";
    constexpr std::string_view tcpListening = "0A";
    const std::string table = isTcp ? "/proc/net/tcp" : "/proc/net/udp";
    std::vector<std::string> sockets;
    for (const char* version : {"", "6"}) {
        collectSockets(table + version, isTcp ? tcpListening : udpUnconnected, port, sockets);
    }
    if (sockets.empty()) {
        return std::nullopt;
    }
    std::error_code missing;
    for (fs::directory_iterator entry("/proc", missing), end; !missing && entry != end;
         entry.increment(missing)) {
        const std::string id = entry->path().filename().string();
        if (id.find_first_not_of("0123456789") == std::string::npos && holdsAnyOf(entry->path(), sockets)) {
            std::ifstream file(entry->path() / "comm");
            Process process{{}, std::strtoll(id.c_str(), nullptr, 10)};
            std::getline(file, process.name);
            return process;
        }
    }
    return std::nullopt;
}

NetError withHolder(NetError error, std::uint16_t port, bool isTcp) {
    const std::size_t place = error.text.find(kByAnother);
    if (error.kind != Kind::PortInUse || place == std::string::npos) {
        return error;
    }
    if (const auto holder = holderOfPort(port, isTcp)) {
        const std::string process = " (process " + std::to_string(holder->id) + ")";
        // Closing it is not what its operator wants.
        const bool isOurs = holder->name == "posewire";
        error.text.replace(place, isOurs ? std::string::npos : kByAnother.size(),
                           isOurs
                               ? "by another Posewire" + process +
                                     "; look there, or choose another port here and let the other relay to it"
                               : "by " + holder->name + process);
    }
    return error;
}

NetResult<UdpSockets> bindUdp(Input& input, int bufferBytes) {
    const InputStatus asked = input.status();
    auto sockets = bindAll(asked.endpoint, asked.groups, bufferBytes);
    if (sockets) {
        input.setPort(sockets->front().socket->localPort());
        input.counters().receiveBufferBytes = receiveBufferBytes(*sockets->front().socket);
    }
    return sockets;
}

} // namespace posewire::net
