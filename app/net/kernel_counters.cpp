// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/kernel_counters.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

namespace posewire::net {

std::optional<log::KernelCounters> readKernelCounters(const std::string& root) {
    const std::filesystem::path folder = std::filesystem::path(root) / "proc/net";
    std::map<std::string, std::int64_t> counters;
    std::ifstream pairs(folder / "snmp"); // "Udp: InDatagrams NoPorts", then "Udp: 17 4"
    std::string names;
    std::string values;
    while (std::getline(pairs, names) && std::getline(pairs, values)) {
        std::istringstream name(names);
        std::istringstream value(values);
        std::string group;
        value >> group;
        name >> group;
        for (std::string counter; name >> counter;) {
            value >> counters[group + counter];
        }
    }
    if (counters.empty()) {
        return std::nullopt;
    }
    std::ifstream lines(folder / "snmp6"); // "Udp6NoPorts 4"
    while (lines >> names) {
        lines >> counters[names];
    }
    const auto sum = [&](const char* ofIpv4, const char* ofIpv6) {
        return static_cast<std::uint64_t>(counters[ofIpv4] + counters[ofIpv6]);
    };
    return log::KernelCounters{sum("Ip:ReasmReqds", "Ip6ReasmReqds"), sum("Ip:ReasmOKs", "Ip6ReasmOKs"),
                               sum("Ip:ReasmFails", "Ip6ReasmFails"), sum("Udp:NoPorts", "Udp6NoPorts"),
                               sum("Tcp:OutRsts", "")};
}

} // namespace posewire::net
