// SPDX-License-Identifier: MIT
#include "core/model/body/null_pose.h"

#include "core/model/body/spaces.h"

#include <algorithm>
#include <map>
#include <utility>

namespace posewire::model {
namespace {

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
    m_arriving = {};
    m_arriving.message = message;
    m_arriving.firstPacket = packet;
    m_arriving.firstStamp = stamp;
}

/// Whether the first part of the message that is arriving has not come, and may come now.
bool NullPoseAssembler::isOvertaken(log::Stamp stamp) const {
    return !m_parts.empty() && !m_parts[0] && std::chrono::abs(stamp - m_arriving.firstStamp) <= kTogether;
}

void NullPoseAssembler::add(const wire::NullPose& part, std::uint8_t datagramCounter, std::uint64_t packet,
                            log::Stamp stamp) {
    const std::size_t index = datagramCounter & 0x7fU;
    if (index < m_parts.size() && m_parts[index] == part && stamp - m_arriving.stamp < kDuplicate) {
        return;
    }
    if (m_arriving.message == 0 || m_arriving.isComplete() ||
        (index == 0 && !part.segments.empty() && !isOvertaken(stamp))) {
        begin(packet, stamp);
    }
    m_parts.resize(std::max(m_parts.size(), index + 1));
    m_parts[index] = part;
    if ((datagramCounter & 0x80U) != 0) {
        m_arriving.partsExpected = static_cast<unsigned>(index + 1);
    }
    m_arriving.missingParts.clear();
    for (std::size_t place = 0; place < m_parts.size(); ++place) {
        if (!m_parts[place]) {
            m_arriving.missingParts.push_back(static_cast<unsigned>(place));
        }
    }
    m_arriving.partsReceived = static_cast<unsigned>(m_parts.size() - m_arriving.missingParts.size());
    m_arriving.stamp = stamp;
    m_arriving.packet = packet;
    settle();
}

void NullPoseAssembler::settle() {
    m_arriving.segments.clear();
    m_arriving.points.clear();
    for (const auto& part : m_parts) {
        if (!part) {
            continue;
        }
        for (const wire::NullPoseSegment& segment : part->segments) {
            m_arriving.segments.push_back({segment.name, toVector(segment.position)});
        }
        for (const wire::NullPosePoint& point : part->points) {
            m_arriving.points.push_back(
                {point.segment, point.point, point.name, point.flags, toVector(point.position)});
        }
    }
    // A part that is lost must not keep the segments of a new performer from being used.
    const bool isElsewhere =
        !std::ranges::equal(m_arriving.segments, m_settled.segments,
                            [](const auto& a, const auto& b) { return a.position == b.position; });
    if (!m_arriving.segments.empty() && (m_arriving.isComplete() || !m_settled.isComplete() || isElsewhere)) {
        m_settled = m_arriving;
    }
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
    const auto later = std::ranges::upper_bound(m_versions, packet, {}, &Version::firstPacket);
    if (later != m_versions.begin()) {
        return &*std::prev(later);
    }
    return m_versions.size() < kMost ? nullptr : &m_versions.front();
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
