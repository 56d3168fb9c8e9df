// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/firewall.h"

#include <filesystem>
#include <fstream>
#include <system_error>

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
        return Firewall{"nftables", "ask the administrator to accept PORT/udp in /etc/nftables.conf"};
    }
    if (hasLine(base / "proc/net/ip_tables_names", "filter")) {
        return Firewall{"iptables", "sudo iptables -I INPUT -p udp --dport PORT -j ACCEPT"};
    }
    return std::nullopt;
}

} // namespace posewire::net
