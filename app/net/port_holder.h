// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace posewire::net {

struct Process {
    std::string name;
    std::int64_t id = 0;
};

/// The process that listens on a port of this computer. Empty where the system does not reveal it: off Linux,
/// and for other users' processes.
[[nodiscard]] std::optional<Process> holderOfUdpPort(std::uint16_t port);
[[nodiscard]] std::optional<Process> holderOfTcpPort(std::uint16_t port);

} // namespace posewire::net
