// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/kernel_counters.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

namespace posewire::net {

std::optional<model::KernelCounters> readKernelCounters(const std::string& root) {
    const std::filesystem::path folder = std::filesystem::path(root) / "proc/net";
    std::ifstream pairs(folder / "snmp"); // "Udp: InDatagrams NoPorts", then "Udp: 17 4"
    std::map<std::string, std::int64_t> counters;
    std::string names;
    std::string values;
    while (std::getline(pairs, names) && std::getline(pairs, values)) {
        std::istringstream name(names);
        std::istringstream value(values);
        std::string group;
        std::string counter;
        std::int64_t number = 0;
        value >> group;
        name >> group;
        while (name >> counter && value >> number) {
            counters[group + counter] = number;
        }
    }
    if (counters.empty()) {
        return std::nullopt;
    }
    std::ifstream lines(folder / "snmp6"); // "Udp6NoPorts 4"
    std::int64_t number = 0;
    while (lines >> names >> number) {
        counters[names] = number;
    }
    const auto sum = [&](const char* ofIpv4, const char* ofIpv6) {
        return static_cast<std::uint64_t>(counters[ofIpv4] + counters[ofIpv6]);
    };
    return model::KernelCounters{sum("Ip:ReasmReqds", "Ip6ReasmReqds"), sum("Ip:ReasmOKs", "Ip6ReasmOKs"),
                                 sum("Ip:ReasmFails", "Ip6ReasmFails"), sum("Udp:NoPorts", "Udp6NoPorts"),
                                 static_cast<std::uint64_t>(counters["Tcp:OutRsts"])};
}

} // namespace posewire::net
