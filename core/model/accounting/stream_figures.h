// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/stream_index.h"
#include "core/log/time.h"
#include "core/model/accounting/stream.h"
#include "core/model/accounting/stream_accounting.h"
#include "core/model/accounting/stream_counts.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace posewire::model {

/// Samples per second; of types without samples, datagrams per second. 0 before there are two.
struct RateFigures {
    double nowHz = 0;  ///< over the newest 2 s; in a range the mean
    double meanHz = 0; ///< of samples that arrived whole
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
/// With all rates but that of now.
[[nodiscard]] RangeFigures figuresOf(const StreamAccounting& stream, const std::optional<TimeRange>& range);

struct RangePart {
    std::uint32_t datagrams = 0;
    std::uint32_t samples = 0;
    std::uint32_t lost = 0; ///< samples, incomplete ones included

    [[nodiscard]] double lossShare() const {
        return lost == 0 ? 0 : static_cast<double>(lost) / (lost + samples);
    }
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

/// Every figure of a stream. Those up to Drift are in `posewire-cli monitor --json`, in this order.
enum class Figure : std::uint8_t {
    Datagrams,
    Samples,
    Lost,
    Duplicates,
    Reordered,
    Late,
    Incomplete,
    Restarts,
    Step,
    RateWhole,
    Jitter,
    LongestGap,
    FirstSample,
    LastSample,
    Bytes,
    Malformed,
    LossShare,
    LostHere,
    LostOnNetwork,
    LostAtSender,
    LostUnknown,
    LostOnWay,
    Bursts,
    BurstDensity,
    GapDensity,
    BurstLength,
    SpacingMean,
    SpacingLeast,
    SpacingMost,
    SpacingDeviation,
    Skew,
    Drift,
    Missing,
    Rate,
    RateMean,
    RateLeast,
    RateMost,
    RateDeviation,
    DatagramRate,
    Bandwidth,
};
inline constexpr std::size_t kFigures = static_cast<std::size_t>(Figure::Bandwidth) + 1;

enum class FigureForm : std::uint8_t {
    Count,   ///< how many, a whole number
    Counter, ///< a whole number that is none of things: its digits are not grouped
    Number,  ///< with decimals
    Signed,  ///< with decimals, and a plus where the sign matters to people
    Share,   ///< a ratio, which people read as percent
};

enum class FigureSum : std::uint8_t {
    None, ///< makes no sense of several
    Sum,
    Most, ///< that of the worst stream
    Mean, ///< weighted by the samples expected
};

/// A count of losses is Odd, its share a Warning, so that one loss is said once in colour.
enum class FigureTrouble : std::uint8_t { None, Odd, Warning, Error };

/// Only streams that count samples, or messages (types 10 to 13) as well: in their rows alone, or in sums
/// too.
enum class FigureScope : std::uint8_t { Samples, Rows, Messages };

/// Decimals: of JSON, of reports and of the window. A share counts as percent in the last two.
struct FigureDigits {
    int json = 0;
    int report = 0;
    int window = 0;
};

struct FigureStyle {
    FigureForm form = FigureForm::Count;
    const char* unit = "";
    FigureDigits digits{};
};

struct FigureRow {
    Figure figure;
    /// The name in JSON, "lost"; a dot leads into an object, "clock.driftMs". Empty: not in JSON.
    std::string_view key;
    const char* title; ///< of a column, with the unit
    FigureStyle style;
    FigureSum sum;
    FigureTrouble trouble;
    double (*read)(const RangeFigures&); ///< NaN if it is not known
    const char* help;                    ///< what it is, and who defined it
    FigureScope scope = FigureScope::Samples;
    const char* column = nullptr;    ///< a short title, where columns are narrow
    const char* condition = nullptr; ///< display filter for the packets at which it counts
    const char* packets = nullptr;   ///< what those are, in a menu

    [[nodiscard]] const char* shortTitle() const { return column != nullptr ? column : title; }
};

/// All figures, in the order of the enum.
[[nodiscard]] std::span<const FigureRow, kFigures> figureTable();
[[nodiscard]] const FigureRow& rowOf(Figure figure);

/// The figures of one stream, or a sum of several.
class StreamFigures {
public:
    /// A sum of nothing yet.
    StreamFigures();
    StreamFigures(const log::StreamKey& key, const RangeFigures& read);

    /// NaN if it is not known: times between samples before there are two, clock skew without time codes.
    [[nodiscard]] double operator[](Figure figure) const {
        return m_values[static_cast<std::size_t>(figure)];
    }
    /// 0 if it is not known.
    [[nodiscard]] double orZero(Figure figure) const;
    [[nodiscard]] std::uint64_t count(Figure figure) const {
        return static_cast<std::uint64_t>(orZero(figure));
    }
    /// True if it means anything here: messages without samples and sums lack some.
    [[nodiscard]] bool has(Figure figure) const;
    /// True if it is one to look at.
    [[nodiscard]] FigureTrouble trouble(Figure figure) const;

    [[nodiscard]] const log::StreamKey& key() const { return m_key; } ///< of a stream
    [[nodiscard]] bool isSampled() const { return m_isSampled; }
    [[nodiscard]] bool isFromTimeCode() const; ///< else the sample counter is the sender's clock
    /// Samples that should have come.
    [[nodiscard]] double expected() const;

    void add(const StreamFigures& other);
    void set(Figure figure, double value) { m_values[static_cast<std::size_t>(figure)] = value; }

private:
    log::StreamKey m_key{};
    bool m_isSum = false;
    bool m_isSampled = false;
    std::array<double, kFigures> m_values{};
};

/// Open ends of a range: before and after every stamp, and far enough from the bounds to be rounded.
inline constexpr TimeRange kAllTime{log::Stamp::min() + std::chrono::years(1),
                                    log::Stamp::max() - std::chrono::years(1)};

/// All there is where no range is given; either end of the range may be that of kAllTime. In a range whose
/// losses they were is not known here: all are unknown.
[[nodiscard]] StreamFigures figuresOf(const Stream& stream, const std::optional<TimeRange>& range = {});

} // namespace posewire::model
