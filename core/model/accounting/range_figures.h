// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/accounting/stream_accounting.h"
#include "core/model/accounting/stream_counts.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace posewire::model {

/// Samples per second; of types without samples, datagrams per second. 0 before there are two.
struct RateFigures {
    double nowHz = 0;   ///< over the newest 2 s; in a range the mean
    double wholeHz = 0; ///< of samples that arrived whole
    double meanHz = 0;
    /// Of parts of the range, each at least a second long and on the air from its beginning to its end;
    /// without such a part all are as the mean, and the deviation 0.
    double leastHz = 0;
    double mostHz = 0;
    double deviationHz = 0;
    double datagramsPerSecond = 0;
    double bytesPerSecond = 0;
};

/// Every figure of one stream in a range of time.
struct RangeFigures {
    StreamCounts counts;
    InterArrival arrivals;
    ClockFigures clock; ///< the jitter at the end of the range; skew and drift over it
    RateFigures rate;
    LossPattern pattern;
    std::uint64_t malformed = 0; ///< datagrams with a header of the stream that could not be decoded
    LossesByCause lostByCause{};
};

/// The figures that a stream's accounting keeps, of all its time where no range is given. Without rates the
/// cost does not depend on the range.
[[nodiscard]] RangeFigures countedFigures(const StreamAccounting& stream,
                                          const std::optional<TimeRange>& range);
/// With all rates but those of now and of whole samples.
[[nodiscard]] RangeFigures figuresOf(const StreamAccounting& stream, const std::optional<TimeRange>& range);

/// What came and what did not in a part of a range.
struct RangePart {
    std::uint32_t datagrams = 0;
    std::uint32_t samples = 0;
    std::uint32_t lost = 0; ///< samples, incomplete ones included

    RangePart& operator+=(const RangePart& other);
};

/// Equal parts that follow one another, in whole buckets of the accounting.
struct RangeParts {
    log::Stamp first{};    ///< where the first one begins
    log::Duration width{}; ///< 0: there are none
    std::size_t count = 0;

    [[nodiscard]] log::Stamp beginOf(std::size_t part) const {
        return first + static_cast<std::int64_t>(part) * width;
    }
};

/// At most `most` parts of at least `leastWidth` that cover a range, so that none mixes buckets of a
/// history with that resolution.
[[nodiscard]] RangeParts partsOf(const TimeRange& range, std::size_t most, log::Duration leastWidth,
                                 log::Duration resolution);

/// Adds what a stream has in each part.
void addParts(const StreamAccounting& stream, const RangeParts& parts, std::span<RangePart> into);

} // namespace posewire::model
