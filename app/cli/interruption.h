// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace posewire::cli {

/// While it lives, Ctrl+C (and a polite request to end) does not end the program but is remembered; a second
/// one ends it. One at a time.
class Interruption {
public:
    Interruption();
    ~Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;

    [[nodiscard]] bool hasCome() const;
};

} // namespace posewire::cli
