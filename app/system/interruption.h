// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace posewire::system {

/// While one lives, the first Ctrl+C (SIGINT), SIGTERM or SIGHUP is only remembered, so that the program ends
/// in good order; one that comes half a second later or more ends the program at once. Calls of the system
/// that wait are interrupted. A SIGHUP that is ignored stays so (nohup). On Windows it is Ctrl+C, Ctrl+Break
/// and the end of the console. One object at a time.
class Interruption {
public:
    Interruption();
    ~Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;

    /// Since the newest object was made. From any thread.
    [[nodiscard]] static bool hasCome();
};

} // namespace posewire::system
