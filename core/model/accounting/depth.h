// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace posewire::model {

/// How much of each stream is remembered. Counts do not depend on it: how late a datagram may come, and how
/// fine ranges of time are, do. The more streams there are the less it is, so that all of them together take
/// about as much as kFullStreams.
struct AccountingDepth {
    /// As many streams are remembered in full.
    static constexpr std::size_t kFullStreams = 512;

    std::size_t samples = 4096; ///< the newest, before and after a restart each; a power of two from 512 on
    std::size_t buckets = 2048; ///< of time in a history

    friend bool operator==(const AccountingDepth&, const AccountingDepth&) = default;

    /// For so many streams, which are kStreamLimit at most.
    [[nodiscard]] static constexpr AccountingDepth of(std::size_t streams) {
        AccountingDepth depth;
        for (std::size_t most = kFullStreams; streams > most && depth.samples > 512; most *= 2) {
            depth.samples /= 2;
            depth.buckets /= 2;
        }
        return depth;
    }
};

} // namespace posewire::model
