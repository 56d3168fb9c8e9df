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

/// The process that listens on a port of this computer. Empty if the system does not reveal it, as for
/// other users' processes.
[[nodiscard]] std::optional<Process> holderOfPort(std::uint16_t port, bool isTcp);

} // namespace posewire::net
