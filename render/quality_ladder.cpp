// SPDX-License-Identifier: MIT
#include "render/quality_ladder.h"

#include "render/renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace posewire::render {
namespace {

/// Seconds on a step before one up is tried: at first, and at most after tries that failed.
constexpr double kPatience = 1.5;
constexpr double kLongestPatience = 60.0;
/// A step up that is left within this many seconds has failed.
constexpr double kTrial = 4.0;
/// After this long without having to step down again, the past is forgotten.
constexpr double kForgiving = 30.0;
/// What was learned is believed that much less after each such time.
constexpr double kDoubtAfter = 60.0;
constexpr double kDoubt = 0.8;
/// Share of the budget that the pictures of a higher step may be expected to take.
constexpr double kRoom = 0.85;
/// Nothing is left to leave out then but pictures: those may take this many times the budget before.
constexpr double kMostAtFullRate = 2.0;
/// Device pixels.
constexpr float kMiddlingBody = 450.0F;

} // namespace

RenderQuality simplified(RenderQuality quality, Simplification step) {
    using enum Simplification;
    quality.lowShadows = quality.lowShadows || step >= LowShadows;
    if (step >= SmallShadows) {
        quality.shadowMapSize = std::min(quality.shadowMapSize, 512);
        quality.floorShadowSize = std::min(quality.floorShadowSize, 256);
    }
    if (step >= LowBodies) {
        quality.lowBodiesBelow = std::max(quality.lowBodiesBelow, kMiddlingBody);
    }
    quality.hardSelfShadow = quality.hardSelfShadow || step >= HardSelfShadows;
    if (step >= RawEdges) {
        quality.edgeSmoothing = false;
        quality.lowBodiesBelow = std::numeric_limits<float>::max();
    }
    return quality;
}

void QualityLadder::add(double took, double now) {
    if (!(took >= 0.0)) {
        return;
    }
    m_took[m_count % kPictures] = took;
    ++m_count;
    if (m_count < kPictures) {
        return;
    }
    m_typical = median();
    if (m_count == kPictures) {
        learn();
    }
    if (m_patience == 0.0 || (m_wasUp && now - m_moved > kForgiving)) {
        m_patience = kPatience;
    }
    const bool isNearlyLast = m_step >= kLastSimplification - 1;
    if (m_typical > (isNearlyLast ? kMostAtFullRate : 1.0) * m_budget) {
        stepDown(now);
    } else {
        stepUp(now);
    }
}

double QualityLadder::median() const {
    std::array<double, kPictures> sorted = m_took;
    std::ranges::nth_element(sorted, sorted.begin() + kPictures / 2);
    return sorted[kPictures / 2];
}

/// What the steps between the one that was left and this one save.
void QualityLadder::learn() {
    const int steps = std::abs(m_step - m_leftStep);
    if (steps == 0 || !(m_typical > 0.0) || !(m_leftTypical > 0.0)) {
        return;
    }
    const double ratio = m_step > m_leftStep ? m_leftTypical / m_typical : m_typical / m_leftTypical;
    const double each = std::clamp(std::pow(ratio, 1.0 / steps), 1.0, 4.0);
    for (int step = std::min(m_step, m_leftStep) + 1; step <= std::max(m_step, m_leftStep); ++step) {
        m_gain[static_cast<std::size_t>(step)] = each;
    }
}

void QualityLadder::stepDown(double now) {
    if (m_step == kLastSimplification) {
        return;
    }
    if (m_wasUp && now - m_moved < kTrial) {
        m_patience = std::min(2.0 * m_patience, kLongestPatience);
    }
    m_cause = m_typical;
    m_wasUp = false;
    const int far = m_typical > 2.0 * m_budget && m_step < kLastSimplification - 2 ? 2 : 1;
    move(m_step + far, now);
}

void QualityLadder::stepUp(double now) {
    if (m_step == 0 || now - m_moved < m_patience) {
        return;
    }
    double& gain = m_gain[static_cast<std::size_t>(m_step)];
    const double budget = (m_step == kLastSimplification ? kMostAtFullRate : 1.0) * m_budget;
    if (m_typical * gain > kRoom * budget) {
        if (now - std::max(m_moved, m_doubted) > kDoubtAfter + m_patience) {
            gain = 1.0 + kDoubt * (gain - 1.0);
            m_doubted = now;
        }
        return;
    }
    m_wasUp = true;
    move(m_step - 1, now);
}

void QualityLadder::move(int step, double now) {
    m_leftStep = m_step;
    m_leftTypical = m_typical;
    m_step = step;
    m_count = 0;
    m_moved = now;
}

} // namespace posewire::render
