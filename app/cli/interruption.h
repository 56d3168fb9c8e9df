// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace posewire::cli {

/// During its lifetime the first Ctrl+C (or SIGTERM) is only remembered; a second one ends the program. One
/// object at a time.
class Interruption {
public:
    Interruption();
    ~Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;

    [[nodiscard]] bool hasCome() const;
};

} // namespace posewire::cli
