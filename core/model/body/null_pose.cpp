// SPDX-License-Identifier: MIT
#include "core/model/body/null_pose.h"

#include "core/model/body/segments.h"
#include "core/model/body/spaces.h"

#include <algorithm>
#include <bit>
#include <functional>
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

ForeignText textOf(const std::string& bytes) {
    ForeignText name(bytes);
    if (bytes.size() > NullPose::kMostNameBytes) {
        name.forgetExact();
    }
    return name;
}

/// What was sent as one number: parts that the network repeats have the same.
class Digest {
public:
    void add(std::uint64_t value) { m_value = (std::rotl(m_value, 5) ^ value) * 0x9e3779b97f4a7c15U; }
    void add(std::string_view text) { add(std::hash<std::string_view>{}(text)); }
    void add(const wire::Vec3& values) {
        for (const float value : values) {
            add(std::bit_cast<std::uint32_t>(value));
        }
    }
    [[nodiscard]] std::uint64_t value() const { return m_value; }

private:
    std::uint64_t m_value = 0;
};

std::uint64_t hashOf(const wire::NullPose& part) {
    Digest digest;
    digest.add(part.segments.size());
    for (const wire::NullPoseSegment& segment : part.segments) {
        digest.add(segment.name);
        digest.add(segment.position);
    }
    for (const wire::NullPosePoint& point : part.points) {
        digest.add(std::uint64_t{point.segment} << 48U | std::uint64_t{point.point} << 32U | point.flags);
        digest.add(point.name);
        digest.add(point.position);
    }
    return digest.value();
}

template <class Item>
std::size_t bytesOf(const Item& item) {
    return sizeof(Item) + item.name.memoryBytes();
}

std::size_t bytesOf(const NullPose& pose) {
    std::size_t bytes = sizeof(NullPose);
    for (const NullPose::Segment& segment : pose.segments) {
        bytes += bytesOf(segment);
    }
    for (const NullPose::Point& point : pose.points) {
        bytes += bytesOf(point);
    }
    return bytes;
}

std::size_t bytesOf(const NullPoseMessage& message) {
    return sizeof(message) + message.missingParts.capacity() * sizeof(unsigned);
}

/// Puts as many items into a list as there is room for, at a place in it. Returns how many.
template <class Item>
std::size_t insert(std::vector<Item> items, std::size_t place, std::size_t& bytes, std::vector<Item>& list) {
    std::size_t count = 0;
    while (count < items.size() && bytes + bytesOf(items[count]) <= NullPose::kMostBytes) {
        bytes += bytesOf(items[count++]);
    }
    const auto begin = std::make_move_iterator(items.begin());
    list.insert(list.begin() + static_cast<std::ptrdiff_t>(place), begin,
                begin + static_cast<std::ptrdiff_t>(count));
    return count;
}

} // namespace

std::string NullPose::Segment::title() const {
    const std::string_view known = segmentTitle(name.exact());
    return known.empty() ? name.shown() : std::string(known);
}

void NullPoseAssembler::begin(std::uint64_t packet, log::Stamp stamp) {
    const std::uint64_t message = m_arriving.message + 1;
    m_parts.clear();
    m_bytes = 0;
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
    const std::uint64_t hash = hashOf(part);
    if (index < m_parts.size() && m_parts[index] && m_parts[index]->hash == hash &&
        stamp - m_arriving.stamp < kDuplicate) {
        return;
    }
    if (m_arriving.message == 0 || m_arriving.isComplete() ||
        (index == 0 && !part.segments.empty() && !isOvertaken(stamp))) {
        begin(packet, stamp);
    }
    m_parts.resize(std::max(m_parts.size(), index + 1));
    m_parts[index] = take(part, index);
    m_parts[index]->hash = hash;
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

/// Puts what a part has at its place among the others, instead of what the same part brought before.
NullPoseAssembler::Part NullPoseAssembler::take(const wire::NullPose& part, std::size_t index) {
    std::size_t segment = 0;
    std::size_t point = 0;
    for (std::size_t place = 0; place < index; ++place) {
        segment += m_parts[place] ? m_parts[place]->segments : 0;
        point += m_parts[place] ? m_parts[place]->points : 0;
    }
    const auto remove = [this](auto& list, std::size_t first, std::size_t count) {
        const auto begin = list.begin() + static_cast<std::ptrdiff_t>(first);
        const auto end = begin + static_cast<std::ptrdiff_t>(count);
        std::for_each(begin, end, [this](const auto& item) { m_bytes -= bytesOf(item); });
        list.erase(begin, end);
    };
    if (const auto& before = m_parts[index]) {
        remove(m_arriving.segments, segment, before->segments);
        remove(m_arriving.points, point, before->points);
    }
    std::vector<NullPose::Segment> segments;
    for (const wire::NullPoseSegment& each : part.segments) {
        segments.push_back({textOf(each.name), toVector(each.position)});
    }
    std::vector<NullPose::Point> points;
    for (const wire::NullPosePoint& each : part.points) {
        points.push_back({each.segment, each.point, textOf(each.name), each.flags, toVector(each.position)});
    }
    const std::size_t sent = segments.size() + points.size();
    const Part taken{0, insert(std::move(segments), segment, m_bytes, m_arriving.segments),
                     insert(std::move(points), point, m_bytes, m_arriving.points)};
    m_arriving.leftOut += sent - taken.segments - taken.points;
    return taken;
}

void NullPoseAssembler::settle() {
    // A part that is lost must not keep the segments of a new performer from being used.
    const auto isElsewhere = [this] {
        return !std::ranges::equal(m_arriving.segments, m_settled->segments,
                                   [](const auto& a, const auto& b) { return a.position == b.position; });
    };
    if (m_arriving.segments.empty() ||
        !(m_arriving.isComplete() || m_settled == nullptr || !m_settled->isComplete() || isElsewhere())) {
        return;
    }
    if (!m_arriving.isComplete()) {
        m_settled = std::make_shared<const NullPose>(m_arriving);
        return;
    }
    auto whole = std::make_shared<NullPose>(std::move(m_arriving));
    static_cast<NullPoseMessage&>(m_arriving) = *whole;
    m_arriving.message = whole->message;
    m_arriving.packet = whole->packet;
    m_arriving.segments.clear();
    m_arriving.points.clear();
    m_bytes = 0;
    m_settled = std::move(whole);
}

std::size_t NullPoseAssembler::memoryBytes() const {
    return sizeof(*this) + m_bytes + m_parts.capacity() * sizeof(m_parts[0]);
}

void NullPoseAssembler::forget() {
    m_settled.reset();
    begin(m_arriving.firstPacket, m_arriving.firstStamp);
    m_parts.shrink_to_fit();
}

bool NullPoseHistory::add(const wire::NullPose& part, std::uint8_t datagramCounter, std::uint64_t packet,
                          log::Stamp stamp) {
    m_assembler.add(part, datagramCounter, packet, stamp);
    note();
    return m_assembler.newest() != nullptr && keep(packet, stamp);
}

void NullPoseHistory::note() {
    const NullPose& arriving = m_assembler.arriving();
    if (arriving.message != m_messageCount) {
        m_messageCount = arriving.message;
        if (m_messages.size() == kMostMessages) {
            m_messages.pop_front();
        }
        m_messages.emplace_back();
    }
    m_messages.back() = arriving;
}

bool NullPoseHistory::keep(std::uint64_t packet, log::Stamp stamp) {
    const std::shared_ptr<const NullPose>& pose = m_assembler.settled();
    if (!m_versions.empty() && m_versions.back().pose == pose) {
        return false;
    }
    if (!m_versions.empty() && m_versions.back().pose->segments == pose->segments &&
        m_versions.back().pose->points == pose->points) {
        m_versions.back().pose = pose;
        return false;
    }
    // Of the steps in which one message arrives, the first and the newest are enough.
    const std::size_t count = m_versions.size();
    if (count >= 2 && m_versions[count - 1].pose->message == pose->message &&
        m_versions[count - 2].pose->message == pose->message) {
        m_versions.pop_back();
    } else if (count == kMostVersions) {
        dropVersion();
    }
    const bool isOther = !m_versions.empty() && isDifferentBody(*m_versions.back().pose, *pose);
    m_versions.push_back({packet, stamp, pose, bytesOf(*pose), isOther});
    return isOther;
}

void NullPoseHistory::dropVersion() {
    m_versions.pop_front();
    ++m_dropped;
}

/// The end where there was none.
std::deque<NullPoseHistory::Version>::const_iterator NullPoseHistory::versionAt(std::uint64_t packet) const {
    const auto later = std::ranges::upper_bound(m_versions, packet, {}, &Version::firstPacket);
    if (later != m_versions.begin()) {
        return std::prev(later);
    }
    return m_dropped == 0 ? m_versions.end() : m_versions.begin();
}

const NullPose* NullPoseHistory::at(std::uint64_t packet) const {
    const auto version = versionAt(packet);
    return version == m_versions.end() ? nullptr : version->pose.get();
}

NullPoseRecord NullPoseHistory::record(std::uint64_t packet) const {
    NullPoseRecord record;
    if (auto version = versionAt(packet); version != m_versions.end()) {
        record.pose = version->pose.get();
        while (version != m_versions.begin() && !version->isOtherBody) {
            --version;
        }
        record.changed = version->firstStamp;
        record.before = version != m_versions.begin() ? std::prev(version)->pose.get() : nullptr;
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

std::size_t NullPoseHistory::memoryBytes() const {
    std::size_t bytes = sizeof(*this) + m_assembler.memoryBytes();
    for (const Version& version : m_versions) {
        bytes += sizeof(version) + version.bytes;
    }
    for (const NullPoseMessage& message : m_messages) {
        bytes += bytesOf(message);
    }
    return bytes;
}

std::optional<Droppable> NullPoseHistory::oldest() const {
    if (m_versions.size() > 1) {
        return Droppable{0, m_versions.front().firstStamp};
    }
    return m_messages.empty() ? std::nullopt : std::optional(Droppable{1, m_messages.back().stamp});
}

std::size_t NullPoseHistory::dropOldest() {
    const std::size_t before = memoryBytes();
    if (m_versions.size() > 1) {
        dropVersion();
    } else {
        m_dropped += m_versions.size();
        m_versions.clear();
        m_messages.clear();
        m_assembler.forget();
    }
    return before - std::min(before, memoryBytes());
}

} // namespace posewire::model
