// SPDX-License-Identifier: MIT
#include "core/model/null_pose.h"

#include "core/model/spaces.h"

#include <algorithm>

namespace posewire::model {
namespace {

constexpr std::size_t kMaxParts = 128; ///< what the 7-bit datagram index can tell apart

bool isSameBody(const NullPose& a, const NullPose& b) {
    const auto sameSegment = [](const auto& x, const auto& y) {
        return x.name == y.name && x.position == y.position;
    };
    const auto samePoint = [](const auto& x, const auto& y) {
        return x.segment == y.segment && x.id == y.id && x.name == y.name && x.flags == y.flags &&
               x.position == y.position;
    };
    return std::equal(a.segments.begin(), a.segments.end(), b.segments.begin(), b.segments.end(),
                      sameSegment) &&
           std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), samePoint);
}

bool isBeginning(std::uint8_t index, const wire::NullPose& part, const std::vector<bool>& present) {
    return index == 0 && !part.segments.empty() && !present.empty();
}

} // namespace

void NullPoseAssembler::add(const wire::NullPose& part, std::uint8_t datagramCounter, std::uint64_t packet,
                            std::int64_t stampNs) {
    const std::size_t index = datagramCounter & 0x7fU;
    if (isBeginning(static_cast<std::uint8_t>(index), part, m_present) || m_arriving.isComplete()) {
        m_parts.clear();
        m_present.clear();
        m_arriving = {};
    }
    if (index >= m_parts.size() && index < kMaxParts) {
        m_parts.resize(index + 1);
        m_present.resize(index + 1);
    }
    m_parts[index] = part;
    m_present[index] = true;
    if ((datagramCounter & 0x80U) != 0) {
        m_arriving.partsExpected = static_cast<unsigned>(index + 1);
    }
    m_arriving.partsReceived = static_cast<unsigned>(std::count(m_present.begin(), m_present.end(), true));
    m_arriving.stampNs = stampNs;
    m_arriving.packet = packet;
    settle();
}

void NullPoseAssembler::settle() {
    m_arriving.segments.clear();
    m_arriving.points.clear();
    for (const wire::NullPose& part : m_parts) {
        for (const wire::NullPoseSegment& segment : part.segments) {
            m_arriving.segments.push_back({segment.name, toVector(segment.position)});
        }
        for (const wire::NullPosePoint& point : part.points) {
            m_arriving.points.push_back(
                {point.segment, point.point, point.name, point.flags, toVector(point.position)});
        }
    }
    // A part that is lost must not keep the segments of a new performer from being used.
    if (m_arriving.isComplete() || (!m_settled.isComplete() && !m_arriving.segments.empty()) ||
        m_arriving.segments.size() != m_settled.segments.size() || hasMoved()) {
        if (!m_arriving.segments.empty()) {
            m_settled = m_arriving;
        }
    }
}

bool NullPoseAssembler::hasMoved() const {
    return !std::equal(m_arriving.segments.begin(), m_arriving.segments.end(), m_settled.segments.begin(),
                       [](const auto& a, const auto& b) { return a.position == b.position; });
}

const NullPose* NullPoseAssembler::newest() const {
    return m_settled.segments.empty() ? nullptr : &m_settled;
}

void NullPoseHistory::add(const wire::NullPose& part, std::uint8_t datagramCounter, std::uint64_t packet,
                          std::int64_t stampNs) {
    m_assembler.add(part, datagramCounter, packet, stampNs);
    const NullPose* newest = m_assembler.newest();
    if (newest == nullptr) {
        return;
    }
    if (!m_versions.empty() && isSameBody(m_versions.back().pose, *newest)) {
        m_versions.back().pose = *newest;
        return;
    }
    if (m_versions.size() == kMost) {
        m_versions.pop_front();
    }
    m_versions.push_back({packet, *newest});
}

const NullPose* NullPoseHistory::at(std::uint64_t packet) const {
    const NullPose* found =
        m_versions.empty() || m_versions.size() < kMost ? nullptr : &m_versions.front().pose;
    for (const Version& version : m_versions) {
        if (version.firstPacket <= packet) {
            found = &version.pose;
        }
    }
    return found;
}

} // namespace posewire::model
