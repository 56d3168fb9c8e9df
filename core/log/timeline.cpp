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

/// Empty if it does not fit.
std::optional<Duration> difference(Duration a, Duration b) {
    const bool isTooMuch = b < Duration::zero() ? a > Duration::max() + b : a < Duration::min() + b;
    return isTooMuch ? std::nullopt : std::optional(a - b);
}
std::optional<Duration> sum(Duration a, Duration b) {
    const bool isTooMuch = b < Duration::zero() ? a < Duration::min() - b : a > Duration::max() - b;
    return isTooMuch ? std::nullopt : std::optional(a + b);
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
    const Duration setBy = next == m_byTime.begin() ? Duration::zero() : std::prev(next)->setBy;
    return WallTime(sum(stamp.time_since_epoch(), setBy).value_or(stamp.time_since_epoch()));
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

/// Where the wall clock was set by `by`; empty if that is no time near the file's first.
std::optional<Stamp> RecordedClock::at(WallTime time, Duration by) const {
    const auto stamp = difference(time.time_since_epoch(), by);
    const auto since = stamp && m_first ? difference(*stamp, m_first->time_since_epoch()) : stamp;
    const bool isNear = since && (!m_first || (*since <= kMostFromFirst && *since >= -kMostFromFirst));
    return isNear ? std::optional(Stamp(*stamp)) : std::nullopt;
}

Stamp RecordedClock::stampOf(WallTime time, Duration setBy) {
    const auto change = difference(setBy, std::exchange(m_declared, setBy));
    const auto declared = change ? sum(m_setBy, *change) : std::nullopt;
    auto stamp = at(time, m_setBy);
    if (change != Duration::zero()) {
        if (const auto meant = declared ? at(time, *declared) : std::nullopt) {
            stamp = meant;
            set(*stamp, *declared);
        }
        m_before.reset();
    } else if (const auto back = m_last && m_before ? at(time, *m_before) : std::nullopt;
               back && std::chrono::abs(*back - *m_last) <= kDisorder &&
               (!stamp || *stamp - *m_last > kDisorder)) {
        stamp = back; // and forth again
        set(*stamp, *m_before);
        m_before.reset();
    }
    if (m_last && (!stamp || *m_last - *stamp > kDisorder || *stamp - *m_last > kLongestPause)) {
        stamp = m_last;
        if (const auto by = difference(time.time_since_epoch(), m_last->time_since_epoch())) {
            m_before = m_setBy;
            set(*stamp, *by);
        }
    }
    const Stamp result = stamp.value_or(asStamp(time));
    m_first = m_first.value_or(result);
    m_last = std::max(m_last.value_or(result), result);
    return result;
}

void RecordedClock::end() {
    if (m_last && m_setBy != Duration::zero()) {
        m_timeline->add({*m_last + Duration(1), Duration::zero(), Duration::zero()});
    }
}

void RecordedClock::set(Stamp from, Duration setBy) {
    m_timeline->add({from, setBy, difference(setBy, m_setBy).value_or(Duration::max())});
    m_setBy = setBy;
}

} // namespace posewire::log
