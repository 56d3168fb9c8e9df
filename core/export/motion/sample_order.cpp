// SPDX-License-Identifier: MIT
#include "core/export/motion/sample_order.h"

#include "core/model/accounting/probation.h"
#include "core/model/accounting/sample_window.h"

#include <utility>

namespace posewire::exporting {
namespace {

using model::distance;

/// So many samples that agree are a restart.
constexpr std::size_t kAgreeing = 2;

bool isNear(std::uint32_t sample, std::uint32_t expected) {
    const std::int32_t ahead = distance(sample, expected);
    return ahead >= -model::Probation::kMostBack && ahead <= model::Probation::kMostForward;
}

} // namespace

bool SampleOrder::isExpected(std::uint32_t sample) const {
    if (m_waiting.empty() && !m_taken) {
        return true;
    }
    return isNear(sample, m_waiting.empty() ? *m_taken : m_waiting.back().pose.sample);
}

void SampleOrder::add(MotionSample sample) {
    const log::Stamp now = sample.pose.stamp;
    if (isExpected(sample.pose.sample)) {
        insert(std::move(sample));
        if (!m_doubted.empty() && now - m_doubted.back().pose.stamp > kWait) {
            m_doubted.clear();
        }
    } else {
        doubt(std::move(sample));
    }
    release(now);
}

void SampleOrder::insert(MotionSample sample) {
    if (m_taken && distance(sample.pose.sample, *m_taken) <= 0) {
        return; // it came before, or waited for too long
    }
    auto place = m_waiting.end();
    while (place != m_waiting.begin() && distance(std::prev(place)->pose.sample, sample.pose.sample) > 0) {
        --place;
    }
    if (place == m_waiting.begin() || std::prev(place)->pose.sample != sample.pose.sample) {
        m_waiting.insert(place, std::move(sample));
    } else if (sample.rank < std::prev(place)->rank) {
        *std::prev(place) = std::move(sample);
    }
}

void SampleOrder::doubt(MotionSample sample) {
    const std::uint32_t number = sample.pose.sample;
    if (!m_doubted.empty() && !isNear(number, m_doubted.back().pose.sample)) {
        m_doubted.clear();
    }
    for (MotionSample& other : m_doubted) {
        if (other.pose.sample == number) {
            other = sample.rank < other.rank ? std::move(sample) : std::move(other);
            return;
        }
    }
    m_doubted.push_back(std::move(sample));
    if (m_doubted.size() < kAgreeing) {
        return;
    }
    std::vector<MotionSample> agreeing = std::exchange(m_doubted, {});
    beginRun();
    for (MotionSample& one : agreeing) {
        insert(std::move(one));
    }
}

void SampleOrder::release(log::Stamp now) {
    while (!m_waiting.empty() && (now - m_waiting.front().pose.stamp > kWait || m_waiting.size() > kMost)) {
        takeFirst();
    }
}

void SampleOrder::beginRun() {
    while (!m_waiting.empty()) {
        takeFirst();
    }
    m_doubted.clear();
    m_taken.reset();
}

void SampleOrder::takeFirst() {
    const MotionSample first = std::move(m_waiting.front());
    m_waiting.pop_front();
    const bool beginsRun = !m_taken.has_value();
    m_taken = first.pose.sample;
    m_take(first, beginsRun);
}

} // namespace posewire::exporting
