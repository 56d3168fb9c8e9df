// SPDX-License-Identifier: MIT
#include "core/model/body/pose_interpolation.h"

#include <algorithm>
#include <utility>

namespace posewire::model {

bool PoseInterpolation::isContinued(const CharacterPose& newest) const {
    constexpr int kSeldom = 2; // a sample that is shown once leaves no time between
    const log::Duration time = newest.stamp - m_newest.stamp;
    return m_asked >= kSeldom && time > log::Duration::zero() && time <= kLongest &&
           newest.segments.size() == m_newest.segments.size() && newest.isObjects == m_newest.isObjects &&
           newest.isLifted == m_newest.isLifted;
}

void PoseInterpolation::begin(const CharacterPose& newest) {
    m_isGliding = isContinued(newest);
    m_time = newest.stamp - m_newest.stamp;
    std::swap(m_from, m_shown);
    m_newest = newest;
    m_shown = newest;
    m_asked = 0;
}

const CharacterPose& PoseInterpolation::at(const CharacterPose& newest, log::Stamp now) {
    if (newest.packet != m_newest.packet || newest.stamp != m_newest.stamp ||
        newest.isLifted != m_newest.isLifted) {
        begin(newest);
    }
    ++m_asked;
    const double share =
        m_isGliding ? std::clamp(log::secondsOf(now - m_newest.stamp) / log::secondsOf(m_time), 0.0, 1.0) : 1;
    m_isUnderWay = share < 1;
    for (std::size_t i = 0; i < m_newest.segments.size(); ++i) {
        const SegmentPose& to = m_newest.segments[i];
        const bool isBetween = share < 1 && m_newest.isPresent(i) && m_from.isPresent(i);
        m_shown.segments[i] = isBetween
                                  ? SegmentPose{m_from.segments[i].position +
                                                    share * (to.position - m_from.segments[i].position),
                                                m_from.segments[i].orientation.slerp(share, to.orientation)}
                                  : to;
    }
    return m_shown;
}

} // namespace posewire::model
