// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/progress_line.h"

#include "app/system/standard_streams.h"

#include <cmath>
#include <iostream>
#include <utility>

namespace posewire::cli {

ProgressLine::ProgressLine(std::string command)
    : m_command(std::move(command)), m_isTerminal(system::isTerminal(system::kStandardError)) {}

void ProgressLine::show(const std::string& work, double share) {
    const auto now = std::chrono::steady_clock::now();
    if (!m_isTerminal || now < m_next) {
        return;
    }
    m_next = now + std::chrono::milliseconds(100);
    m_isShown = true;
    std::cerr << "\r\x1b[K" << m_command << ": " << work << ' ' << std::lround(100 * share) << " %"
              << std::flush;
}

void ProgressLine::clear() {
    if (m_isShown) {
        std::cerr << "\r\x1b[K" << std::flush;
        m_isShown = false;
    }
}

} // namespace posewire::cli
