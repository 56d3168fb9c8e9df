// SPDX-License-Identifier: MIT
#include "core/performer/loss_pattern.h"

namespace posewire::performer {
namespace {

/// The chance of a burst to begin where none is, so that a share `drop` of all datagrams is lost.
double burstChance(double drop, int burst) {
    if (drop >= 1.0) {
        return 1.0;
    }
    const double lost = drop / burst;
    return lost / (lost + 1.0 - drop);
}

} // namespace

LossPattern::LossPattern(const FaultSettings& settings, const KeyedRandom& random)
    : m_random(random),
      m_burstChance(burstChance(settings.drop, settings.burst)),
      m_burst(settings.burst),
      m_model(settings.gilbertElliott) {}

bool LossPattern::loses() {
    ++m_asked;
    if (m_model) {
        return losesByState();
    }
    if (m_leftOfBurst == 0 && m_random.uniform(m_asked) < m_burstChance) {
        m_leftOfBurst = m_burst;
    }
    if (m_leftOfBurst == 0) {
        return false;
    }
    --m_leftOfBurst;
    return true;
}

bool LossPattern::losesByState() {
    const double change = m_isBad ? m_model->toGood : m_model->toBad;
    if (m_random.uniform(2 * m_asked) < change) {
        m_isBad = !m_isBad;
    }
    const double passes = m_isBad ? m_model->passesInBad : m_model->passesInGood;
    return m_random.uniform(2 * m_asked + 1) >= passes;
}

} // namespace posewire::performer
