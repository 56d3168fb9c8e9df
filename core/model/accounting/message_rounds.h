// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace posewire::model {

/// Counts messages of which some but not all datagrams came, among those that are sent again and again with
/// the same sample counter (types 10 to 13). Datagrams that come within kTogetherNs of each other, in any
/// order and any number of times, are of one message.
class MessageRounds {
public:
    static constexpr std::int64_t kTogetherNs = 250'000'000;

    /// Returns true for a repeat within one message.
    bool add(std::int64_t stampNs, std::uint8_t datagram, bool isLast);

    [[nodiscard]] std::uint64_t incomplete() const { return m_incomplete; }

private:
    [[nodiscard]] bool isWhole() const;

    std::uint64_t m_incomplete = 0; ///< the newest message included
    std::int64_t m_newestNs = 0;
    std::array<std::uint64_t, 2> m_arrived{};
    int m_last = -1;
    bool m_isOpen = false;
};

} // namespace posewire::model
