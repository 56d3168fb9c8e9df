// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/port_holder.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace posewire::net {
namespace {

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

/// Empty if the system does not say.
std::optional<fs::path> holderOf(const std::vector<std::string>& sockets) {
    std::error_code missing;
    for (fs::directory_iterator entry("/proc", missing), end; !missing && entry != end;
         entry.increment(missing)) {
        const std::string id = entry->path().filename().string();
        if (id.find_first_not_of("0123456789") == std::string::npos && holdsAnyOf(entry->path(), sockets)) {
            return entry->path();
        }
    }
    return std::nullopt;
}

/// Whoever waits for a port asks again and again, and all processes take long to look through: only if a
/// port has other sockets than last time, or their holder has let go of them.
class KnownHolders {
public:
    std::optional<fs::path> find(std::uint16_t port, bool isTcp, const std::vector<std::string>& sockets) {
        const std::lock_guard lock(m_mutex);
        Known& known = m_known[{port, isTcp}];
        const bool isStill =
            known.sockets == sockets && (!known.holder || holdsAnyOf(*known.holder, sockets));
        if (!isStill) {
            known = {sockets, holderOf(sockets)};
        }
        return known.holder;
    }

private:
    struct Known {
        std::vector<std::string> sockets;
        std::optional<fs::path> holder;
    };

    std::mutex m_mutex;
    std::map<std::pair<std::uint16_t, bool>, Known> m_known;
};

} // namespace

std::optional<Process> holderOfPort(std::uint16_t port, bool isTcp) {
    static KnownHolders known;
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
    const auto holder = known.find(port, isTcp, sockets);
    if (!holder) {
        return std::nullopt;
    }
    std::ifstream file(*holder / "comm");
    Process process{{}, std::strtoll(holder->filename().c_str(), nullptr, 10)};
    std::getline(file, process.name);
    return process;
}

} // namespace posewire::net
