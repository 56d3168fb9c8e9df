// SPDX-License-Identifier: MIT
#include "core/model/body/null_pose.h"

#include "core/model/body/spaces.h"

#include <algorithm>
#include <map>
#include <utility>

namespace posewire::model {
namespace {

constexpr std::size_t kMaxParts = 128; ///< what the 7-bit datagram index can tell apart

bool isBeginning(std::size_t index, const wire::NullPose& part, const std::vector<bool>& present) {
    return index == 0 && !part.segments.empty() &&
           std::find(present.begin(), present.end(), true) != present.end();
}

std::vector<unsigned> missingOf(const std::vector<bool>& present) {
    std::vector<unsigned> missing;
    for (std::size_t i = 0; i < present.size(); ++i) {
        if (!present[i]) {
            missing.push_back(static_cast<unsigned>(i));
        }
    }
    return missing;
}

log::Duration median(std::vector<log::Duration> values) {
    if (values.empty()) {
        return {};
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Whether two messages contradict each other: another list of segments, or a segment or point that both have
/// elsewhere or under another name. Points that only one of them has are no difference: parts get lost.
bool isDifferentBody(const NullPose& a, const NullPose& b) {
    if (a.segments != b.segments) {
        return true;
    }
    std::map<std::pair<int, int>, const NullPose::Point*> points;
    for (const NullPose::Point& point : a.points) {
        points.insert_or_assign({point.segment, point.id}, &point);
    }
    return std::ranges::any_of(b.points, [&](const NullPose::Point& point) {
        const auto other = points.find({point.segment, point.id});
        return other != points.end() && *other->second != point;
    });
}

} // namespace

void NullPoseAssembler::begin(std::uint64_t packet, log::Stamp stamp) {
    const std::uint64_t message = m_arriving.message + 1;
    m_parts.clear();
    m_present.clear();
    m_arriving = {};
    m_arriving.message = message;
    m_arriving.firstPacket = packet;
    m_arriving.firstStamp = stamp;
}

void NullPoseAssembler::add(const wire::NullPose& part, std::uint8_t datagramCounter, std::uint64_t packet,
                            log::Stamp stamp) {
    const std::size_t index = datagramCounter & 0x7fU;
    if (index < m_parts.size() && m_present[index] && stamp - m_arriving.stamp < kDuplicate &&
        m_parts[index] == part) {
        return;
    }
    if (m_arriving.message == 0 || isBeginning(index, part, m_present) || m_arriving.isComplete()) {
        begin(packet, stamp);
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
    m_arriving.missingParts = missingOf(m_present);
    m_arriving.stamp = stamp;
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
                          log::Stamp stamp) {
    m_assembler.add(part, datagramCounter, packet, stamp);
    note();
    if (const NullPose* newest = m_assembler.newest()) {
        keep(*newest, packet, stamp);
    }
}

void NullPoseHistory::note() {
    const NullPose& arriving = m_assembler.arriving();
    if (arriving.message != m_messageCount) {
        m_messageCount = arriving.message;
        if (m_messages.size() == kMost) {
            m_messages.pop_front();
        }
        m_messages.emplace_back();
    }
    m_messages.back() = arriving;
}

void NullPoseHistory::keep(const NullPose& pose, std::uint64_t packet, log::Stamp stamp) {
    if (!m_versions.empty() && m_versions.back().pose.segments == pose.segments &&
        m_versions.back().pose.points == pose.points) {
        m_versions.back().pose = pose;
        return;
    }
    // Of the steps in which one message arrives, the first and the newest are enough.
    const std::size_t count = m_versions.size();
    if (count >= 2 && m_versions[count - 1].pose.message == pose.message &&
        m_versions[count - 2].pose.message == pose.message) {
        m_versions.pop_back();
    } else if (count == kMost) {
        m_versions.pop_front();
    }
    m_versions.push_back({packet, stamp, pose});
}

const NullPoseHistory::Version* NullPoseHistory::versionAt(std::uint64_t packet) const {
    const Version* found = m_versions.size() < kMost ? nullptr : &m_versions.front();
    for (const Version& version : m_versions) {
        if (version.firstPacket <= packet) {
            found = &version;
        }
    }
    return found;
}

const NullPose* NullPoseHistory::at(std::uint64_t packet) const {
    const Version* version = versionAt(packet);
    return version == nullptr ? nullptr : &version->pose;
}

NullPoseRecord NullPoseHistory::record(std::uint64_t packet) const {
    NullPoseRecord record;
    if (const Version* version = versionAt(packet)) {
        record.pose = &version->pose;
        record.changed = version->firstStamp;
        auto other = std::ranges::find(m_versions, version, [](const Version& each) { return &each; });
        while (record.before == nullptr && other != m_versions.begin()) {
            --other;
            if (isDifferentBody(other->pose, version->pose)) {
                record.before = &other->pose;
            } else {
                record.changed = other->firstStamp;
            }
        }
    }
    std::vector<log::Duration> spaces;
    record.messages = m_messageCount;
    for (const NullPoseMessage& message : m_messages) {
        if (message.firstPacket > packet) {
            --record.messages;
            continue;
        }
        if (record.newest != nullptr) {
            spaces.push_back(message.firstStamp - record.newest->firstStamp);
            record.incompleteMessages += record.newest->isComplete() ? 0 : 1;
        }
        record.newest = &message;
    }
    record.repetition = median(std::move(spaces));
    return record;
}

} // namespace posewire::model
