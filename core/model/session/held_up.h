// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"

#include <optional>

namespace posewire::model {

/// Whether this program was held up just now: it was stopped, or its computer slept. What came meanwhile is
/// still in the socket then, and nobody may be called silent before it is read.
class HeldUp {
public:
    /// Asked each time before the log is followed. One that is always slow is held up every other time.
    [[nodiscard]] bool at(log::Stamp now) {
        const bool isLong = m_last && now - *m_last > kLong && !m_isHeldUp;
        m_until = isLong ? now + kReading : m_until;
        m_last = now;
        m_isHeldUp = now < m_until;
        return m_isHeldUp;
    }

private:
    static constexpr log::Duration kLong = std::chrono::milliseconds(250);
    /// All that a socket holds is read by then.
    static constexpr log::Duration kReading = std::chrono::milliseconds(100);

    std::optional<log::Stamp> m_last;
    log::Stamp m_until = log::Stamp::min();
    bool m_isHeldUp = false;
};

} // namespace posewire::model
