// SPDX-License-Identifier: MIT
#include "core/log/timeline.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace posewire::log {
namespace {

/// Stamps of the kernel and readings of the clock are that near.
constexpr Duration kNear = std::chrono::milliseconds(2);

/// What the wall clock is ahead of the monotonic one, and how exactly that could be read: a thread may be
/// interrupted between the two.
struct Reading {
    Duration ahead{};
    Duration took = Duration::max();

    [[nodiscard]] bool isExact() const { return took < std::chrono::microseconds(100); }
};

Reading read(const Clock& clock) {
    constexpr int kMost = 8;
    Reading best;
    for (int i = 0; i < kMost && !best.isExact(); ++i) {
        const Moment before = clock.monotonic();
        const WallTime wall = clock.wall();
        const Duration took = clock.monotonic() - before;
        if (took < best.took) {
            best = {wall.time_since_epoch() - before.time_since_epoch() - took / 2, took};
        }
    }
    return best;
}

} // namespace

Duration Timeline::origin(const Clock& clock) const {
    Duration origin = m_origin.load(std::memory_order_relaxed);
    if (origin == Duration::min()) {
        const Duration wanted = read(clock).ahead;
        origin = m_origin.compare_exchange_strong(origin, wanted) ? wanted : origin;
    }
    return origin;
}

Stamp Timeline::now(const Clock& clock) const {
    return Stamp(origin(clock) + clock.monotonic().time_since_epoch());
}

std::optional<Duration> Timeline::wallAhead(const Clock& clock) const {
    const Reading reading = read(clock);
    return reading.isExact() ? std::optional(reading.ahead - origin(clock)) : std::nullopt;
}

WallTime Timeline::wallOf(Stamp stamp) const {
    if (stepCount() == 0) {
        return asWallTime(stamp);
    }
    const std::lock_guard lock(m_mutex);
    const auto next = std::ranges::upper_bound(m_byTime, stamp, {}, &ClockStep::from);
    return asWallTime(next == m_byTime.begin() ? stamp : stamp + std::prev(next)->setBy);
}

Stamp Timeline::stampOf(WallTime time) const {
    const std::lock_guard lock(m_mutex);
    Stamp end = Stamp::max();
    for (auto step = m_byTime.rbegin(); step != m_byTime.rend(); ++step) {
        if (const Stamp stamp = asStamp(time) - step->setBy; stamp >= step->from) {
            return std::min(stamp, end);
        }
        end = step->from;
    }
    return std::min(asStamp(time), end);
}

void Timeline::add(const ClockStep& step) {
    const std::lock_guard lock(m_mutex);
    if (m_noticed.size() < kMostSteps) {
        m_noticed.push_back(step);
        m_byTime.insert(std::ranges::upper_bound(m_byTime, step.from, {}, &ClockStep::from), step);
        m_count.store(m_noticed.size(), std::memory_order_release);
    }
}

ClockStep Timeline::step(std::size_t index) const {
    const std::lock_guard lock(m_mutex);
    return m_noticed[index];
}

ClockWatch::ClockWatch(Timeline& timeline, const Clock& clock)
    : m_timeline(timeline), m_clock(clock), m_now(timeline.now(clock)), m_stepAfter(m_now) {}

Stamp ClockWatch::look() {
    const auto ahead = m_timeline.wallAhead(m_clock);
    if (ahead && std::chrono::abs(*ahead - m_setBy) >= kLeastStep) {
        settle();
        m_before = std::exchange(m_setBy, *ahead);
        m_stepAfter = m_now;
        m_isUntold = true;
    }
    m_now = m_timeline.now(m_clock);
    return m_now;
}

Stamp ClockWatch::stampOf(WallTime time) {
    const Stamp since = asStamp(time) - m_setBy;
    const bool isSince = since >= m_stepAfter - kNear && since <= m_now + kNear;
    if (isSince && m_isUntold) {
        tell(since);
    }
    return isSince || m_setBy == m_before ? since : asStamp(time) - m_before;
}

void ClockWatch::settle() {
    if (m_isUntold) {
        tell(m_now);
    }
}

void ClockWatch::tell(Stamp from) {
    m_isUntold = false;
    m_timeline.add({from, m_setBy, m_setBy - m_before});
}

Stamp RecordedClock::stampOf(WallTime time, Duration setBy) {
    const auto at = [time](Duration by) { return asStamp(time) - by; };
    if (const Duration change = setBy - std::exchange(m_declared, setBy); change != Duration::zero()) {
        set(at(m_setBy + change), m_setBy + change);
        m_before.reset();
    } else if (m_last && m_before && at(m_setBy) - *m_last > kDisorder &&
               std::chrono::abs(at(*m_before) - *m_last) <= kDisorder) {
        set(at(*m_before), *m_before); // and forth again
        m_before.reset();
    } else if (m_last && *m_last - at(m_setBy) > kDisorder) {
        m_before = m_setBy;
        set(*m_last, m_setBy - (*m_last - at(m_setBy)));
    }
    const Stamp stamp = at(m_setBy);
    m_last = std::max(m_last.value_or(stamp), stamp);
    return stamp;
}

void RecordedClock::end() {
    if (m_last && m_setBy != Duration::zero()) {
        m_timeline->add({*m_last + Duration(1), Duration::zero(), Duration::zero()});
    }
}

void RecordedClock::set(Stamp from, Duration setBy) {
    m_timeline->add({from, setBy, setBy - m_setBy});
    m_setBy = setBy;
}

} // namespace posewire::log
