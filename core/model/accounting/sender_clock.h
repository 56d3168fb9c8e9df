// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/accounting/stream_counts.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace posewire::model {

/// In ms. It may be a time of day: back by a day is midnight.
[[nodiscard]] std::int32_t timeCodeStep(std::uint32_t before, std::uint32_t after);

/// Compares the sender's clock with ours. The sender's is the header time code where it advances with the
/// samples, else the sample counter times its own period. O(1) for each sample.
class SenderClock {
public:
    struct Sample {
        log::Stamp stamp{};
        std::uint32_t sample = 0;
        std::uint32_t timeCode = 0; ///< ms
    };
    /// The first datagram of a sample, in the order of arrival. A time code that is far from where its sample
    /// belongs counts once a second one is.
    void add(const Sample& sample);
    /// The counter restarted: nothing from before applies any more, except the jitter.
    void restart();

    [[nodiscard]] double jitterMs() const { return m_jitterMs; }
    /// Else the sample counter times its own period is the sender's clock.
    [[nodiscard]] bool isFromTimeCode() const { return m_timed > m_untimed; }
    /// At the newest sample, our clock minus the sender's time code, both since the first of its generation.
    [[nodiscard]] double differenceMs() const { return m_differenceMs; }
    /// Grows whenever what comes has nothing to do with what came.
    [[nodiscard]] std::uint32_t generation() const { return m_generation; }

private:
    [[nodiscard]] bool isOff(std::int32_t moved, std::int32_t timeCodeMoved) const;

    std::optional<Sample> m_first;
    Sample m_previous;
    double m_jitterMs = 0;
    std::uint64_t m_timed = 0;   ///< successive samples whose time code advanced with them
    std::uint64_t m_untimed = 0; ///< successive samples whose time code did not
    double m_sumSinceMs = 0;     ///< between the successive samples of the period
    double m_sumMoved = 0;
    std::int64_t m_timeCodeMs = 0; ///< since the first sample, without wrap-around
    double m_differenceMs = 0;
    std::uint32_t m_generation = 0;
    bool m_isStill = false;   ///< the newest time code is that of the sample before
    bool m_isInDoubt = false; ///< the newest time code: the clock has jumped, or it is corrupt
};

/// Fits a line to how far our clock is ahead of the sender's, by the least delayed sample of each of equal
/// parts of the time: the network only ever adds to what the clocks differ by. O(1) memory.
class ClockFit {
public:
    /// `span`: from the first to the last that will be added.
    explicit ClockFit(log::Duration span);

    /// In the order of time.
    void add(log::Stamp stamp, double differenceMs);
    [[nodiscard]] ClockSkew skew() const;

private:
    struct Sums {
        std::size_t count = 0;
        double seconds = 0;
        double ms = 0;
        double squares = 0; ///< of seconds
        double squaresMs = 0;
        double products = 0;
        void add(double atSeconds, double differenceMs);
    };
    log::Duration m_width; ///< of a part
    bool m_hasFirst = false;
    log::Stamp m_first{};
    double m_firstMs = 0;
    std::int64_t m_part = 0; ///< number of the one that is being looked at, and its least delayed sample
    log::Stamp m_least{};
    double m_leastMs = 0;
    Sums m_sums; ///< of the parts before it, relative to the first sample
};

} // namespace posewire::model
