// SPDX-License-Identifier: MIT
#include "core/export/motion/sample_order.h"

#include "core/model/accounting/probation.h"
#include "core/model/accounting/sample_window.h"

#include <algorithm>
#include <utility>

namespace posewire::exporting {
namespace {

using model::distance;

using model::Probation;

constexpr auto kAhead = static_cast<std::int32_t>(Probation::kSteps);
constexpr auto kAheadInDoubt = static_cast<std::int32_t>(Probation::kStepsInDoubt);

bool isNear(std::uint32_t sample, std::uint32_t other) {
    const std::int32_t ahead = distance(sample, other);
    return ahead >= -Probation::kMostBack && ahead <= kAhead;
}

bool isBefore(const MotionSample& one, std::uint32_t sample) {
    return distance(one.pose.sample, sample) < 0;
}

} // namespace

bool SampleOrder::Run::lacks(std::uint32_t sample) const {
    if ((taken && distance(sample, *taken) <= 0) || distance(sample, highest) > 0) {
        return false;
    }
    const auto place = std::lower_bound(waiting.begin(), waiting.end(), sample, isBefore);
    return place == waiting.end() || place->pose.sample != sample;
}

void SampleOrder::Run::insert(MotionSample sample) {
    const std::uint32_t number = sample.pose.sample;
    if (taken && distance(number, *taken) <= 0) {
        return; // it came before, or too late
    }
    const bool isFirst = waiting.empty() && !taken;
    highest = isFirst || distance(number, highest) > 0 ? number : highest;
    const auto place = std::lower_bound(waiting.begin(), waiting.end(), number, isBefore);
    if (place == waiting.end() || place->pose.sample != number) {
        waiting.insert(place, std::move(sample));
    } else if (sample.rank < place->rank) {
        *place = std::move(sample);
    }
}

/// From before a restart.
bool SampleOrder::mayStraggle(std::uint32_t sample) const {
    return std::any_of(m_runs.begin(), m_runs.end() - 1, [&](const Run& run) { return run.lacks(sample); });
}

bool SampleOrder::isExpected(std::uint32_t sample) const {
    if (m_runs.empty()) {
        return true;
    }
    const std::int32_t ahead = distance(sample, m_runs.back().highest);
    return ahead >= -Probation::kMostBack && ahead <= (mayStraggle(sample) ? kAheadInDoubt : kAhead);
}

void SampleOrder::add(MotionSample sample) {
    const log::Stamp now = sample.pose.stamp;
    if (isExpected(sample.pose.sample)) {
        const bool isNew = m_runs.empty();
        if (isNew) {
            m_runs.emplace_back();
        }
        const bool isAdvance = isNew || distance(sample.pose.sample, m_runs.back().highest) > 0;
        m_runs.back().insert(std::move(sample));
        if (isAdvance) {
            advance();
        }
    } else {
        doubt(std::move(sample));
    }
    release(now);
}

/// The run goes on, so what was doubted before is no new place: it is late, or damaged.
void SampleOrder::advance() {
    std::erase_if(m_doubted, [this](Doubted& one) {
        one.isFresh = false;
        const auto run = std::find_if(m_runs.rbegin(), m_runs.rend(),
                                      [&](const Run& other) { return other.lacks(one.sample.pose.sample); });
        if (run != m_runs.rend()) {
            run->insert(std::move(one.sample));
        }
        return run != m_runs.rend();
    });
}

void SampleOrder::doubt(MotionSample sample) {
    const std::uint32_t number = sample.pose.sample;
    const auto same = std::find_if(m_doubted.begin(), m_doubted.end(),
                                   [&](const Doubted& one) { return one.sample.pose.sample == number; });
    if (same == m_doubted.end()) {
        if (m_doubted.size() == Probation::kMost) {
            m_doubted.erase(m_doubted.begin());
        }
        m_doubted.push_back({std::move(sample)});
    } else if (sample.rank < same->sample.rank) {
        same->sample = std::move(sample);
    }
    const std::int32_t behind = distance(m_runs.back().highest, number);
    const bool mayBeLate = (behind > 0 && behind <= Probation::kMostLate) || mayStraggle(number);
    if (agreeing(number) >= (mayBeLate ? Probation::kAgreeingClosely : Probation::kAgreeing)) {
        believe(number);
    }
}

/// How many were doubted that are near a counter, since the run advanced.
std::size_t SampleOrder::agreeing(std::uint32_t sample) const {
    return static_cast<std::size_t>(
        std::count_if(m_doubted.begin(), m_doubted.end(), [&](const Doubted& one) {
            return one.isFresh && isNear(sample, one.sample.pose.sample);
        }));
}

/// All that was doubted and is near a counter is where the run is now: after a loss, or in a new run.
void SampleOrder::believe(std::uint32_t sample) {
    std::vector<MotionSample> near;
    std::erase_if(m_doubted, [&](Doubted& one) {
        const bool isIts = isNear(sample, one.sample.pose.sample);
        if (isIts) {
            near.push_back(std::move(one.sample));
        }
        return isIts;
    });
    std::sort(near.begin(), near.end(), [](const MotionSample& a, const MotionSample& b) {
        return distance(a.pose.sample, b.pose.sample) < 0;
    });
    const std::int32_t jump = distance(near.front().pose.sample, m_runs.back().highest);
    if (jump <= 0 || jump > Probation::kMostForward) {
        m_runs.emplace_back();
    }
    for (MotionSample& one : near) {
        m_runs.back().insert(std::move(one));
    }
}

void SampleOrder::release(log::Stamp now) {
    const auto isDue = [&](const Run& run) {
        return !run.waiting.empty() && now - run.waiting.front().pose.stamp > kWait;
    };
    while (!m_runs.empty()) {
        std::size_t waiting = 0;
        for (const Run& run : m_runs) {
            waiting += run.waiting.size();
        }
        if (isDue(m_runs.front()) || (waiting > kMost && !m_runs.front().waiting.empty())) {
            takeFirst();
        } else if (m_runs.front().waiting.empty() && m_runs.size() > 1 &&
                   (isDue(m_runs[1]) || waiting > kMost)) {
            m_runs.pop_front();
        } else {
            break;
        }
    }
    std::erase_if(m_doubted, [&](const Doubted& one) { return now - one.sample.pose.stamp > kWait; });
}

void SampleOrder::flush() {
    if (!m_doubted.empty() && agreeing(m_doubted.back().sample.pose.sample) >= Probation::kAgreeing) {
        believe(m_doubted.back().sample.pose.sample);
    }
    while (!m_runs.empty()) {
        if (m_runs.front().waiting.empty()) {
            m_runs.pop_front();
        } else {
            takeFirst();
        }
    }
    m_doubted.clear();
}

void SampleOrder::takeFirst() {
    Run& run = m_runs.front();
    const MotionSample first = std::move(run.waiting.front());
    run.waiting.pop_front();
    const bool beginsRun = !run.taken.has_value();
    run.taken = first.pose.sample;
    m_take(first, beginsRun);
}

} // namespace posewire::exporting
