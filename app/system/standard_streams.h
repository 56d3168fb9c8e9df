// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

/// Standard input, output and error of this program, and the command line that it was started with.
namespace posewire::system {

inline constexpr int kStandardOutput = 1;
inline constexpr int kStandardError = 2;

/// To be called first: all three are open, so that no file takes the place of one; bytes pass as they are,
/// and text is UTF-8.
void prepareStandardStreams();
/// Where the reader of a pipe has gone, or a file may not grow, the failed write says so, and no signal.
void leaveFailedWritesToTheWriter();

[[nodiscard]] bool isTerminal(int descriptor);

struct TerminalSize {
    std::size_t rows = 24;
    std::size_t columns = 80;
};
[[nodiscard]] TerminalSize terminalSize();

/// In UTF-8, whatever the system gave to main().
[[nodiscard]] std::vector<std::string> argumentsOf(int count, char** arguments);

} // namespace posewire::system
