// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <string>

namespace posewire::cli {

/// How far long work is, in one line of standard error that is written over; nothing where that is no
/// terminal.
class ProgressLine {
public:
    explicit ProgressLine(std::string command);
    ~ProgressLine() { clear(); }
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// "reading", 0 to 1; ten times a second at most.
    void show(const std::string& work, double share);
    /// Before anything else is written there.
    void clear();

private:
    std::string m_command;
    bool m_isTerminal;
    bool m_isShown = false;
    std::chrono::steady_clock::time_point m_next{};
};

} // namespace posewire::cli
