// SPDX-License-Identifier: MIT
#include "core/export/motion/key_columns.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace posewire::exporting {

void FloatColumn::add(float value) {
    const std::size_t place = static_cast<std::size_t>(m_size % kBlock);
    if (place == 0) {
        m_blocks.push_back(m_scratch->bytes(kBlock * sizeof(float)));
    }
    std::memcpy(m_blocks.back().get() + place * sizeof(float), &value, sizeof(float));
    ++m_size;
}

KeyColumns::KeyColumns(const Skeleton& skeleton, const std::shared_ptr<log::Scratch>& scratch)
    : m_times(scratch),
      m_positions(skeleton.joints.size(), FloatColumn(scratch)),
      m_rotations(skeleton.joints.size(), FloatColumn(scratch)),
      m_newest(skeleton.joints.size(), Eigen::Quaterniond::Identity()) {}

void KeyColumns::add(double seconds, std::span<const model::SegmentPose> local) {
    float time = static_cast<float>(seconds);
    if (count() == 0) {
        m_first = time;
    } else if (time <= m_last) {
        time = std::nextafter(m_last, std::numeric_limits<float>::infinity());
    }
    m_last = time;
    m_times.add(time);
    for (std::size_t i = 0; i < local.size(); ++i) {
        const Eigen::Vector3d position = model::yUpFromZUp(local[i].position);
        for (const double value : {position.x(), position.y(), position.z()}) {
            m_positions[i].add(static_cast<float>(value));
        }
        Eigen::Quaterniond turn = model::yUpFromZUp(local[i].orientation);
        if (turn.dot(m_newest[i]) < 0) {
            turn.coeffs() = -turn.coeffs();
        }
        m_newest[i] = turn;
        for (const double value : {turn.x(), turn.y(), turn.z(), turn.w()}) {
            m_rotations[i].add(static_cast<float>(value));
        }
    }
}

} // namespace posewire::exporting
