// SPDX-License-Identifier: MIT
#include "core/model/accounting/sender_clock.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace posewire::model {
namespace {

/// A time code that moves by more than this between two samples jumped.
constexpr std::int64_t kMostTimeCodeMs = 60'000;
/// One that is farther than this from where its sample belongs too, or it is corrupt.
constexpr double kMostOffMs = 500;

constexpr log::Duration kLeastPart = std::chrono::milliseconds(250);
constexpr std::int64_t kMostParts = 128;
/// Fewer parts than these show no skew.
constexpr std::size_t kLeastParts = 8;

/// Clocks of ordinary computers differ by up to 100 ppm: a skew that is less sure says nothing of them, but
/// of a time code that runs at a speed of its own.
constexpr double kMostErrorPpm = 50;
constexpr double kMostErrorShare = 0.05;
/// The least delay itself is not the same at both ends: kernels, schedulers and switches are so restless.
constexpr double kRestlessMs = 0.05;
/// A skew that is less than that many of its errors is not seen.
constexpr double kLeastErrors = 2;

constexpr std::int32_t kDayMs = 86'400'000;
/// What came around midnight came within so much.
constexpr std::int32_t kMidnightMs = 60'000;

} // namespace

std::int32_t timeCodeStep(std::uint32_t before, std::uint32_t after) {
    const auto step = static_cast<std::int32_t>(after - before);
    const bool isMidnight = step < kMidnightMs - kDayMs && step > -kDayMs - kMidnightMs &&
                            after < static_cast<std::uint32_t>(kMidnightMs);
    return isMidnight ? step + kDayMs : step;
}

bool SenderClock::isOff(std::int32_t moved, std::int32_t timeCodeMoved) const {
    const double dueMs = m_sumMoved > 0 ? moved * m_sumSinceMs / m_sumMoved : 0;
    return isFromTimeCode() && dueMs != 0 &&
           std::abs(timeCodeMoved - dueMs) > kMostOffMs + std::abs(dueMs) / 4;
}

void SenderClock::restart() {
    m_isInDoubt = false;
    m_first.reset();
    m_timeCodeMs = 0;
    m_differenceMs = 0;
    ++m_generation;
}

void SenderClock::add(const Sample& sample) {
    if (!m_first) {
        m_first = m_previous = sample;
        return;
    }
    const auto moved = static_cast<std::int32_t>(sample.sample - m_previous.sample);
    const auto timeCodeMoved = timeCodeStep(m_previous.timeCode, sample.timeCode);
    if (std::abs(std::int64_t{timeCodeMoved}) > kMostTimeCodeMs ||
        (isOff(moved, timeCodeMoved) && m_isInDoubt)) {
        restart();
        add(sample);
        return;
    }
    m_isInDoubt = isOff(moved, timeCodeMoved);
    if (m_isInDoubt) {
        return;
    }
    const double sinceMs = log::millisecondsOf(sample.stamp - m_previous.stamp);
    if (moved != 0) {
        ++((timeCodeMoved > 0) == (moved > 0) && timeCodeMoved != 0 ? m_timed : m_untimed);
        // Forgets slowly, so that the period follows a sender that changes it.
        constexpr double kKeep = 1 - 1.0 / 1024;
        m_sumSinceMs = m_sumSinceMs * kKeep + sinceMs;
        m_sumMoved = m_sumMoved * kKeep + moved;
    }
    m_timeCodeMs += timeCodeMoved;
    const double periodMs = m_sumMoved > 0 ? m_sumSinceMs / m_sumMoved : 0;
    // Standing still it tells nothing, nor does the step with which it makes up for that.
    const bool isStill = timeCodeMoved == 0;
    const bool wasStill = std::exchange(m_isStill, isStill);
    const bool isTimed = isFromTimeCode() && !isStill && !wasStill;
    const double senderMs = isTimed ? timeCodeMoved : moved * periodMs;
    m_jitterMs += (std::abs(sinceMs - senderMs) - m_jitterMs) / 16;
    m_differenceMs = log::millisecondsOf(sample.stamp - m_first->stamp) - static_cast<double>(m_timeCodeMs);
    m_previous = sample;
}

ClockFit::ClockFit(log::Duration span) : m_width(std::max<log::Duration>(kLeastPart, span / kMostParts)) {}

void ClockFit::Sums::add(double atSeconds, double differenceMs) {
    ++count;
    seconds += atSeconds;
    ms += differenceMs;
    squares += atSeconds * atSeconds;
    squaresMs += differenceMs * differenceMs;
    products += atSeconds * differenceMs;
}

void ClockFit::add(log::Stamp stamp, double differenceMs) {
    if (!m_hasFirst) {
        m_hasFirst = true;
        m_first = m_least = stamp;
        m_firstMs = m_leastMs = differenceMs;
        return;
    }
    const std::int64_t part = (stamp - m_first) / m_width;
    if (part != m_part) {
        m_sums.add(log::secondsOf(m_least - m_first), m_leastMs - m_firstMs);
        m_part = part;
        m_least = stamp;
        m_leastMs = differenceMs;
    } else if (differenceMs < m_leastMs) {
        m_least = stamp;
        m_leastMs = differenceMs;
    }
}

ClockSkew ClockFit::skew() const {
    Sums sums = m_sums;
    const double lastSeconds = log::secondsOf(m_least - m_first);
    sums.add(lastSeconds, m_leastMs - m_firstMs);
    const auto count = static_cast<double>(sums.count);
    const double square = sums.squares - sums.seconds * sums.seconds / count;
    if (!m_hasFirst || sums.count < kLeastParts || square <= 0) {
        return {};
    }
    // Ours minus theirs grows where theirs is slow; 1 ms in a second is 1,000 ppm.
    const double product = sums.products - sums.seconds * sums.ms / count;
    const double slope = -product / square;
    const double unexplained = std::max(0.0, sums.squaresMs - sums.ms * sums.ms / count + slope * product);
    const double error = std::hypot(std::sqrt(unexplained / (count - 2) / square), kRestlessMs / lastSeconds);
    if (error > std::max(kMostErrorPpm * 1e-3, kMostErrorShare * std::abs(slope))) {
        return {};
    }
    return std::abs(slope) > kLeastErrors * error ? ClockSkew{slope * 1e3, slope * lastSeconds, error * 1e3}
                                                  : ClockSkew{0, 0, error * 1e3};
}

} // namespace posewire::model
