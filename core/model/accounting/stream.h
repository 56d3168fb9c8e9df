// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/stream_index.h"
#include "core/model/accounting/loss_cause.h"
#include "core/model/accounting/stream_accounting.h"
#include "core/model/accounting/stream_statistics.h"

#include <array>
#include <cstdint>

namespace posewire::model {

/// One message type of one character of one sender.
struct Stream {
    explicit Stream(const log::StreamKey& streamKey) : key(streamKey), accounting(streamKey.type) {}

    log::StreamKey key;
    StreamStatistics statistics; ///< how fast it is now
    StreamAccounting accounting; ///< what came and what did not
    /// Samples lost or incomplete whose cause was found, by LossCause; all others are Unknown.
    std::array<std::uint64_t, kLossCauses> attributed{};

    /// All samples lost and incomplete by LossCause.
    [[nodiscard]] std::array<std::uint64_t, kLossCauses> lostByCause() const;
};

} // namespace posewire::model
