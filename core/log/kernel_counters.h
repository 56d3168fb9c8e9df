// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace posewire::log {

/// The kernel's counters of all network traffic of this computer.
struct KernelCounters {
    std::uint64_t fragments = 0;          ///< of IP, that had to be put together
    std::uint64_t reassembled = 0;        ///< datagrams that were
    std::uint64_t reassemblyFailures = 0; ///< fragments that were given up
    std::uint64_t noPort = 0;             ///< UDP datagrams to ports where no program listens
    std::uint64_t refusedTcp = 0;         ///< resets that were sent, as for TCP connections to such ports

    [[nodiscard]] KernelCounters since(const KernelCounters& before) const {
        return {fragments - before.fragments, reassembled - before.reassembled,
                reassemblyFailures - before.reassemblyFailures, noPort - before.noPort,
                refusedTcp - before.refusedTcp};
    }
    /// Fragments come whose others do not. They are given up after half a minute; until then it shows in that
    /// none is put together.
    [[nodiscard]] bool lacksFragments() const {
        constexpr std::uint64_t kMany = 20;
        return reassemblyFailures >= kMany || (fragments >= kMany && reassembled == 0);
    }

    friend bool operator==(const KernelCounters&, const KernelCounters&) = default;
};

} // namespace posewire::log
