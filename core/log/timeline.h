// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/clock.h"
#include "core/log/time.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

namespace posewire::log {

/// Somebody set the wall clock.
struct ClockStep {
    Stamp from{};      ///< from here on
    Duration setBy{};  ///< the wall clock is ahead of stamps by this
    Duration change{}; ///< by how much it was set this time; zero if it only shows what it showed before
};

/// The time of a log. A stamp runs steadily; the wall clock that it began with may be set meanwhile, which is
/// kept here. Safe from any thread.
class Timeline {
public:
    /// More are not kept: times of day are wrong then, stamps are not.
    static constexpr std::size_t kMostSteps = 4096;

    /// Now. The first call sets what a stamp of this log is.
    [[nodiscard]] Stamp now(const Clock& clock) const;
    /// What the wall clock is ahead of now; empty if both could not be read at about the same time.
    [[nodiscard]] std::optional<Duration> wallAhead(const Clock& clock) const;

    [[nodiscard]] WallTime wallOf(Stamp stamp) const;
    /// What it was ahead of that stamp.
    [[nodiscard]] Duration setByAt(Stamp stamp) const { return wallOf(stamp) - asWallTime(stamp); }
    /// When it last showed that; where it never did, when it was set across it.
    [[nodiscard]] Stamp stampOf(WallTime time) const;

    void add(const ClockStep& step);
    /// Never goes back.
    [[nodiscard]] std::size_t stepCount() const { return m_count.load(std::memory_order_acquire); }
    /// In the order in which they were noticed.
    [[nodiscard]] ClockStep step(std::size_t index) const;

private:
    [[nodiscard]] Duration origin(const Clock& clock) const;

    mutable std::atomic<Duration> m_origin =
        Duration::min(); ///< a stamp less the monotonic time; min() at first
    std::atomic<std::size_t> m_count = 0;
    mutable std::mutex m_mutex; ///< guards what follows
    std::vector<ClockStep> m_noticed;
    std::vector<ClockStep> m_byTime;
};

/// Notices when the clock of this computer is set, and gives the kernel's stamps their place on the time
/// line. One thread.
class ClockWatch {
public:
    /// The reading of two clocks one after the other is not exact, and less than this disturbs no figure.
    static constexpr Duration kLeastStep = std::chrono::milliseconds(1);

    ClockWatch(Timeline& timeline, const Clock& clock)
        : m_timeline(timeline), m_clock(clock), m_now(timeline.now(clock)), m_stepAfter(m_now) {}

    /// To be called after packets were read and before they are stamped: a step between two calls is between
    /// their packets. Returns now.
    Stamp look();

    /// The stamp of what the kernel received at `time`, before the last look().
    [[nodiscard]] Stamp stampOf(WallTime time);

    /// No packet will show any more where the last step was: takes it to have been just now.
    void settle();

private:
    void tell(Stamp from);

    Timeline& m_timeline;
    const Clock& m_clock;
    Stamp m_now;             ///< of the last look
    Stamp m_stepAfter;       ///< the last step was after this
    Duration m_setBy{};      ///< by all steps so far
    Duration m_before{};     ///< by all but the last one
    bool m_isUntold = false; ///< the time line does not have the last step yet
};

/// Puts the packets of one file on the time line: by what a recording says of its clock, else by what can be
/// seen: a clock does not go back by itself. Whatever a file says, the stamps that it gives can be subtracted
/// from each other.
class RecordedClock {
public:
    /// Packets of several interfaces may be out of order by this.
    static constexpr Duration kDisorder = std::chrono::seconds(1);
    /// Nobody waits longer for the next packet: somebody set the clock forward.
    static constexpr Duration kLongestPause = std::chrono::hours(24 * 30);

    explicit RecordedClock(Timeline& timeline) : m_timeline(&timeline) {}

    /// `setBy`: what the recording says the clock had been set by since its beginning.
    [[nodiscard]] Stamp stampOf(WallTime time, Duration setBy);

    void end();

private:
    static constexpr Duration kMostFromFirst{std::int64_t{1} << 61};

    [[nodiscard]] std::optional<Stamp> at(WallTime time, Duration by) const;
    void set(Stamp from, Duration setBy);

    Timeline* m_timeline;
    std::optional<Stamp> m_first;
    std::optional<Stamp> m_last; ///< the latest
    Duration m_setBy{};
    Duration m_declared{};
    std::optional<Duration> m_before; ///< before it was seen to go back
};

} // namespace posewire::log
