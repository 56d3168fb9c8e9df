// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/accounting/count_history.h"
#include "core/model/accounting/sample_step.h"
#include "core/model/accounting/sample_window.h"
#include "core/model/accounting/stream_counts.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace posewire::model {

struct Placement {
    enum class Kind : std::uint8_t {
        Advance,   ///< of a sample above all before
        Filled,    ///< the first of a sample that seemed lost
        Part,      ///< a further one of a sample
        Duplicate, ///< it came before
        Outside,   ///< too old: it has been forgotten
    };
    Kind kind = Kind::Outside;
    bool isReordered = false;
    bool isCompleting = false;      ///< it is the last datagram that its sample lacked
    log::Duration late{};           ///< of a reordered one: since the first arrival above it (RFC 4737 §4.3)
    std::uint32_t gap = 0;          ///< samples missing just before an advance, as far as the step is known
    std::uint32_t sampleBefore = 0; ///< the highest before an advance with a gap
};

/// The samples of a stream between two restarts. It is cut into runs of one step each; per run, always,
/// (last - first) / step + 1 = samples + incomplete + lost. Later samples correct what was counted before.
class SampleSequence {
public:
    struct Datagram {
        log::Stamp stamp{};
        std::uint32_t sample = 0;
        std::uint8_t index = 0; ///< in its sample
        bool isLast = false;
    };

    /// Counts a datagram. Changes are added to `history` at the time when the samples were due, unless it is
    /// null.
    Placement place(const Datagram& datagram, CountHistory* history);

    /// Every sample of which the first datagram came has no other: calls f(sample) for those that seemed
    /// incomplete.
    void completeAll(CountHistory* history, const std::function<void(std::uint32_t)>& f);

    /// Adds samples, incomplete and lost ones.
    void addTo(StreamCounts& counts) const;

    [[nodiscard]] bool empty() const { return m_window.empty(); }
    [[nodiscard]] const SampleWindow& window() const { return m_window; }
    [[nodiscard]] std::uint32_t step() const { return m_runCount == 0 ? 0 : newestRun().step; }
    [[nodiscard]] std::uint32_t first() const { return m_first; }
    [[nodiscard]] std::uint32_t highest() const { return m_window.back().sample; }
    /// True if counters from `low` to `high` overlap what is remembered, from `below` before the oldest
    /// sample to `above` beyond the highest.
    [[nodiscard]] bool overlaps(std::uint32_t low, std::uint32_t high, std::int32_t below,
                                std::int32_t above) const;
    /// Samples between two counters, both exclusive, of which nothing has come.
    [[nodiscard]] std::uint32_t missingBetween(std::uint32_t from, std::uint32_t to) const;

    /// Most samples lost in a row; while irregular, the longest difference of counters.
    [[nodiscard]] std::uint64_t longestGap() const;
    /// Adds the bursts that the history does not know yet, those that ended in a range of time.
    void addNewestBursts(const TimeRange& range, BurstCounts& into) const;

    /// How many of the newest samples are remembered. Bursts that this forgets are added to the history.
    void setMost(std::size_t samples, CountHistory* history);

    /// Ends the sequence. A change of step near its end counts even if only a few samples followed it.
    void conclude(CountHistory* history);
    /// Adds the newest bursts to the history. To be called once nothing more comes.
    void addBursts(CountHistory* history);
    /// Adds the newest bursts to the history and forgets everything.
    void clear(CountHistory* history);

private:
    struct Run {
        std::int64_t first = 0; ///< positions: counters without wrap-around
        std::int64_t last = 0;
        std::uint32_t step = 0;
        std::int64_t samples = 0;
        std::int64_t incomplete = 0;
        [[nodiscard]] std::int64_t lost() const;
    };
    static constexpr std::size_t kRuns = 8;
    [[nodiscard]] Run& newestRun() { return m_runs[m_runCount - 1]; }
    [[nodiscard]] const Run& newestRun() const { return m_runs[m_runCount - 1]; }
    [[nodiscard]] std::int64_t position(std::uint32_t sample) const;
    Run& runFor(std::int64_t position);
    Placement advance(const Datagram& datagram, CountHistory* history);
    Placement fill(const Datagram& datagram, std::size_t index, CountHistory* history);
    Placement mark(const Datagram& datagram, std::size_t index, CountHistory* history, bool isSteady = false);
    [[nodiscard]] log::Stamp dueStamp(std::size_t index) const;
    void reconsiderStep(CountHistory* history);
    void correctStep(std::uint32_t step, CountHistory* history);
    void changeStep(std::uint32_t step);
    [[nodiscard]] bool isTransitionTo(std::uint32_t step) const;
    void splitRun(std::size_t firstEntry, std::uint32_t step);
    [[nodiscard]] std::size_t firstOfRun(const Run& run, std::size_t most) const;
    [[nodiscard]] std::uint64_t lostBefore(std::size_t index, const Run*& run) const;
    [[nodiscard]] std::uint64_t gapBefore(std::size_t index, std::uint64_t lost, const Run* run) const;
    [[nodiscard]] std::int64_t lostNow() const;
    void settle(std::size_t most, CountHistory* history);

    SampleWindow m_window;
    std::int64_t m_highest = 0; ///< position
    std::uint32_t m_first = 0;  ///< as on the wire
    std::array<Run, kRuns> m_runs{};
    std::size_t m_runCount = 0;
    bool m_hasPast = false;
    Run m_past; ///< sums of runs before those kept
    std::int64_t m_pastLost = 0;
    LossBursts m_bursts;
    std::uint64_t m_longestGap = 0; ///< of what m_bursts has seen
    std::size_t m_settled = 0;      ///< entries at the front of the window that m_bursts has seen
};

} // namespace posewire::model
