// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/export/reports.h"

#include <string>
#include <vector>

namespace posewire::cli {

/// What `monitor` shows while it runs: a line for the whole, then each sender with its characters and a line
/// for each of their streams. Texts from the wire are made harmless for a terminal.
[[nodiscard]] std::vector<std::string> liveTable(const model::SessionView& session,
                                                 const exporting::MonitorFacts& facts);

/// How many characters of UTF-8 a text has.
[[nodiscard]] std::size_t widthOf(std::string_view text);

/// Shows tables one after another: over each other on a terminal, else as blocks of lines.
class LiveDisplay {
public:
    explicit LiveDisplay(bool isTerminal) : m_isTerminal(isTerminal) {}

    /// What to write to show these lines; `rows` and `columns` are what the terminal has.
    [[nodiscard]] std::string show(const std::vector<std::string>& lines, std::size_t rows,
                                   std::size_t columns);

private:
    bool m_isTerminal;
    std::size_t m_shown = 0; ///< lines on the terminal that are to be written over
};

} // namespace posewire::cli
