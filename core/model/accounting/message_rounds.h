// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"

#include <array>
#include <cstdint>

namespace posewire::model {

/// Counts messages of which some but not all datagrams came, among those that are sent again and again with
/// the same sample counter (types 10 to 13). Datagrams belong to one message while their indices do not
/// repeat and they come within kTogether of each other, in any order.
class MessageRounds {
public:
    static constexpr log::Duration kTogether = std::chrono::milliseconds(250);

    /// Returns true where the datagram begins a message.
    bool add(log::Stamp stamp, std::uint8_t datagram, bool isLast);

    /// The newest message included.
    [[nodiscard]] std::uint64_t incomplete() const { return m_incomplete; }
    /// Whether the newest message still lacks something.
    [[nodiscard]] bool isPartial() const { return isOpen() && !isWhole(); }

private:
    [[nodiscard]] bool isOpen() const { return (m_arrived[0] | m_arrived[1]) != 0; }
    [[nodiscard]] bool isWhole() const;

    std::uint64_t m_incomplete = 0;
    // Of the newest message:
    log::Stamp m_first{};
    std::array<std::uint64_t, 2> m_arrived{};
    int m_last = -1; ///< index of its last datagram; -1 before that is known
};

} // namespace posewire::model
