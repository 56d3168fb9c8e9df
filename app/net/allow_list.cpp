// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/allow_list.h"

#include <QHostInfo>
#include <QNetworkInterface>

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

namespace posewire::net {
namespace {

constexpr int kBitsOfIpv4 = 32;
constexpr int kBitsOfIpv6 = 128;

QHostAddress plain(const QHostAddress& address) {
    bool isIpv4 = false;
    const QHostAddress ipv4(address.toIPv4Address(&isIpv4));
    return isIpv4 ? ipv4 : address;
}

int bitsOf(const QHostAddress& address) {
    return address.protocol() == QAbstractSocket::IPv4Protocol ? kBitsOfIpv4 : kBitsOfIpv6;
}

QString withoutBrackets(const std::string& entry) {
    const bool isBracketed = entry.size() > 2 && entry.front() == '[' && entry.back() == ']';
    return QString::fromStdString(isBracketed ? entry.substr(1, entry.size() - 2) : entry);
}

/// An address or a net; nothing for a name.
std::optional<std::pair<QHostAddress, int>> netOf(const std::string& entry) {
    const QString text = withoutBrackets(entry);
    if (text.contains(QLatin1Char('/'))) {
        auto net = QHostAddress::parseSubnet(text);
        constexpr int mapped = kBitsOfIpv6 - kBitsOfIpv4; // RFC 4291 section 2.5.5.2
        if (net.second >= mapped && bitsOf(net.first) != bitsOf(plain(net.first))) {
            net = {plain(net.first), net.second - mapped};
        }
        return net.second < 0 ? std::nullopt : std::optional<std::pair<QHostAddress, int>>(net);
    }
    const QHostAddress address(text);
    // "10.1" is an address to some systems, and to nobody who writes a list.
    const bool isWhole = text.contains(QLatin1Char(':')) || text.count(QLatin1Char('.')) == 3;
    return address.isNull() || !isWhole ? std::nullopt
                                        : std::optional(std::pair(plain(address), bitsOf(plain(address))));
}

} // namespace

std::string problemWithEntry(const std::string& entry) {
    const auto isNameLetter = [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '-' || c == '.' || c == '_' || c >= 0x80;
    };
    const bool isNumber =
        std::ranges::all_of(entry, [](unsigned char c) { return std::isdigit(c) != 0 || c == '.'; });
    if (netOf(entry) || (!entry.empty() && !isNumber && std::ranges::all_of(entry, isNameLetter))) {
        return {};
    }
    return "\"" + entry +
           "\" is not a host or a net; write an address, a net such as 192.168.1.0/24, or a name";
}

NetResult<AllowList> AllowList::of(const std::vector<std::string>& entries) {
    AllowList list = withoutNames(entries);
    for (const std::string& entry : entries) {
        if (std::string problem = problemWithEntry(entry); !problem.empty()) {
            return netError(NetError::Kind::BadEndpoint, std::move(problem));
        }
        if (const auto net = netOf(entry)) {
            if (const std::string problem = problemWithZone(net->first); !problem.empty()) {
                return netError(NetError::Kind::AddressNotHere,
                                problem + ", or leave it out to hear that address on all of them");
            }
            continue;
        }
        const QHostInfo info = QHostInfo::fromName(QString::fromStdString(entry));
        if (info.addresses().isEmpty()) {
            return netError(NetError::Kind::HostNotFound,
                            "no computer named " + entry + " was found; check the name or use its address");
        }
        for (const QHostAddress& address : info.addresses()) {
            list.m_nets.push_back({plain(address), bitsOf(plain(address))});
        }
    }
    return list;
}

AllowList AllowList::withoutNames(const std::vector<std::string>& entries) {
    AllowList list;
    list.m_isEveryone = entries.empty();
    for (const std::string& entry : entries) {
        if (const auto net = netOf(entry)) {
            list.m_nets.push_back({net->first, net->second});
        }
    }
    return list;
}

bool AllowList::allows(const QHostAddress& address) const {
    const QHostAddress asked = plain(address);
    const auto isOfZone = [&](const QHostAddress& net) {
        return net.scopeId().isEmpty() ||
               (zoneOf(net).isValid() && zoneOf(net).index() == zoneOf(asked).index());
    };
    return m_isEveryone || std::ranges::any_of(m_nets, [&](const Net& net) {
               return asked.isInSubnet(net.address, net.prefix) && isOfZone(net.address);
           });
}

} // namespace posewire::net
