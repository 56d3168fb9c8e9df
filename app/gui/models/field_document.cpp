// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/field_document.h"

#include "app/gui/models/field_problems.h"
#include "core/model/body/character_pose.h"
#include "core/model/body/joint_angles.h"

#include <algorithm>
#include <cmath>

namespace posewire::gui {

namespace {

using wire::FieldNode;
using wire::NodeKind;
using wire::RefersTo;

constexpr std::int32_t kNone = -1;

std::size_t at(std::int32_t node) {
    return static_cast<std::size_t>(node);
}

Health worse(Health a, Health b) {
    const auto rank = [](Health health) {
        return health == Health::Error ? 2 : health == Health::Warning ? 1 : 0;
    };
    return rank(b) > rank(a) ? b : a;
}

} // namespace

FieldDocument::FieldDocument(const log::Packet& packet, model::LengthUnit unit)
    : m_bytes(packet.bytes.begin(), packet.bytes.end()),
      m_number(packet.number),
      m_stamp(packet.stamp),
      m_sender(packet.sender),
      m_unit(unit) {
    if (packet.flags.skipped) {
        m_kind = model::PacketKind::Skipped;
        FieldNode& rest = m_tree.nodes.emplace_back();
        rest.name = "unread";
        rest.kind = NodeKind::Unread;
        rest.length = static_cast<std::uint32_t>(m_bytes.size());
    } else {
        m_tree = wire::fieldTree(m_bytes, wire::FieldDetail::Parts);
        m_kind = !wire::startsWithMagic(m_bytes) ? model::PacketKind::Foreign
                 : m_tree.fault                  ? model::PacketKind::Malformed
                                                 : model::PacketKind::Datagram;
    }
    if (const auto header = wire::decodeHeader(m_bytes); header && !packet.flags.skipped) {
        m_hasHeader = true;
        m_header = *header;
    }
    arrange();
    readContext();
    findProblems(packet);
    markNodes();
}

/// Sorts the nodes by parent, which keeps them in wire order.
void FieldDocument::arrange() {
    const std::size_t nodes = m_tree.nodes.size();
    m_firstChild.assign(nodes + 2, 0);
    for (const FieldNode& node : m_tree.nodes) {
        ++m_firstChild[at(node.parent + 1) + 1];
    }
    for (std::size_t i = 1; i < m_firstChild.size(); ++i) {
        m_firstChild[i] += m_firstChild[i - 1];
    }
    m_children.resize(nodes);
    std::vector<std::uint32_t> next(m_firstChild.begin(), m_firstChild.end() - 1);
    for (std::size_t i = 0; i < nodes; ++i) {
        m_children[next[at(m_tree.nodes[i].parent + 1)]++] = static_cast<std::int32_t>(i);
    }
}

void FieldDocument::readContext() {
    std::vector<std::uint32_t> ids;
    std::size_t items = 0;
    for (const std::int32_t top : children(kNone)) {
        if (node(top).kind != NodeKind::Group || isInHeader(top)) {
            continue;
        }
        items = std::max<std::size_t>(items, node(top).index);
        for (const std::int32_t item : children(top)) {
            if (const auto id = numberOf(item, RefersTo::Point)) {
                ids.push_back(*id);
            }
        }
    }
    m_layout = model::segmentLayout(m_header, std::min<std::size_t>(items, wire::kMaxItems));
    if (!ids.empty()) {
        m_coding = model::detectPointIdCoding(ids);
    }
}

bool FieldDocument::isInHeader(std::int32_t node) const {
    while (this->node(node).parent >= 0) {
        node = this->node(node).parent;
    }
    return this->node(node).kind == NodeKind::Group && this->node(node).offset == 0;
}

std::optional<std::uint32_t> FieldDocument::numberOf(std::int32_t item, RefersTo what) const {
    for (const std::int32_t child : children(item)) {
        const FieldNode& field = this->node(child);
        if (field.refersTo == what && std::isfinite(field.number)) {
            return static_cast<std::uint32_t>(field.number);
        }
    }
    return std::nullopt;
}

std::optional<model::PointReference> FieldDocument::pointOf(std::uint32_t id) const {
    return model::knownPoint(m_coding, id);
}

std::span<const std::int32_t> FieldDocument::children(std::int32_t node) const {
    if (m_firstChild.empty()) {
        return {};
    }
    const std::uint32_t first = m_firstChild[at(node + 1)];
    return {m_children.data() + first, m_firstChild[at(node + 2)] - first};
}

std::int32_t FieldDocument::itemOf(std::int32_t node) const {
    while (node >= 0 && this->node(node).kind != NodeKind::Item) {
        node = this->node(node).parent;
    }
    return node;
}

std::int32_t FieldDocument::nodeAt(std::uint32_t offset) const {
    const std::int32_t found = m_tree.nodeAt(offset);
    const bool isBits = found >= 0 && node(found).kind == NodeKind::Part && node(found).parent >= 0 &&
                        node(node(found).parent).length == node(found).length;
    return isBits ? node(found).parent : found;
}

std::int32_t FieldDocument::find(const std::string& path) const {
    // From the top down: only what stands beside the way has its path built.
    std::int32_t around = kNone;
    for (bool isDeeper = true; isDeeper;) {
        isDeeper = false;
        for (const std::int32_t child : children(around)) {
            const std::string begin = m_tree.path(child);
            if (begin == path) {
                return child;
            }
            if (path.starts_with(begin) && !children(child).empty() &&
                (path[begin.size()] == '.' || path[begin.size()] == '[')) {
                around = child;
                isDeeper = true;
                break;
            }
        }
    }
    return kNone;
}

int FieldDocument::segmentOf(std::int32_t node) const {
    const std::int32_t item = itemOf(node);
    if (item < 0) {
        return -1;
    }
    const auto index = static_cast<int>(this->node(item).index);
    const auto carrier = [&](RefersTo what) {
        return static_cast<int>(std::min(numberOf(item, what).value_or(0), 1'000'000U)) - 1;
    };
    switch (this->node(item).refersTo) {
    case RefersTo::Segment:
        return index;
    case RefersTo::UnitySegment:
        return index < model::kBodySegmentCount ? model::unityOrder()[static_cast<std::size_t>(index)] : -1;
    case RefersTo::Joint:
        return index < model::kJointCount
                   ? model::jointDefinitions()[static_cast<std::size_t>(index)].childSegment()
                   : -1;
    case RefersTo::Point: {
        const auto id = numberOf(item, RefersTo::Point);
        const auto point = id ? pointOf(*id) : std::nullopt;
        return point ? point->segmentId - 1 : carrier(RefersTo::Carrier);
    }
    case RefersTo::Tracker:
    case RefersTo::Prop:
        return carrier(this->node(item).refersTo);
    default:
        return -1;
    }
}

std::int32_t FieldDocument::nodeOfSegment(int segment) const {
    for (std::int32_t i = 0; segment >= 0 && i < count(); ++i) {
        if (node(i).kind == NodeKind::Item && segmentOf(i) == segment) {
            return i;
        }
    }
    return kNone;
}

void FieldDocument::findProblems(const log::Packet& packet) {
    const auto whole = static_cast<std::uint32_t>(m_bytes.size());
    if (m_kind == model::PacketKind::Skipped || m_kind == model::PacketKind::Foreign) {
        m_problems.push_back({Health::Error, outsideText(*this), 0, whole, count() > 0 ? 0 : kNone});
        return;
    }
    if (packet.flags.truncated) {
        m_problems.push_back({Health::Error, cutByReceiverText(*this), whole, 0, kNone});
    }
    if (m_tree.fault) {
        addFault();
    }
    for (const wire::Notice& notice : m_tree.notices) {
        addNotice(notice);
    }
}

void FieldDocument::addFault() {
    FieldProblem problem{Health::Error, faultText(*this), m_tree.fault->offset, 0, m_tree.cutNode};
    if (problem.node >= 0) {
        problem.offset = node(problem.node).offset;
        problem.length = node(problem.node).length;
    }
    m_problems.push_back(std::move(problem));
    const FieldNode& last = m_tree.nodes.back();
    if (last.kind == NodeKind::Unread) {
        m_problems.push_back({Health::Unknown, unreadText(*this), last.offset, last.length, count() - 1});
    }
}

bool FieldDocument::isAffected(wire::NoticeCode code, std::int32_t index) const {
    const FieldNode& candidate = node(index);
    const auto parts = children(index);
    switch (code) {
    case wire::NoticeCode::NotFinite:
        return candidate.kind == NodeKind::Part && candidate.parent >= 0 &&
               node(candidate.parent).components != 0 && !std::isfinite(candidate.number);
    case wire::NoticeCode::NotUnitQuaternion: {
        if (candidate.components != 4) {
            return false;
        }
        double squared = 0;
        for (const std::int32_t part : parts) {
            squared += node(part).number * node(part).number;
        }
        return !(std::abs(squared - 1) <= 0.02);
    }
    case wire::NoticeCode::SegmentOutOfRange:
        return candidate.kind == NodeKind::Field &&
               (candidate.refersTo == RefersTo::Segment || candidate.refersTo == RefersTo::UnitySegment ||
                candidate.refersTo == RefersTo::Tracker) &&
               (candidate.number < 1 || candidate.number > wire::kMaxSegments);
    default:
        return false;
    }
}

void FieldDocument::addNotice(const wire::Notice& notice) {
    const std::size_t before = m_problems.size();
    FieldProblem problem{Health::Warning, noticeWords(notice), notice.offset, 0, nodeAt(notice.offset)};
    for (std::int32_t i = 0; i < count(); ++i) {
        if (isAffected(notice.code, i)) {
            m_problems.push_back(problem);
            m_problems.back().node = i;
        }
    }
    if (m_problems.size() == before) {
        m_problems.push_back(problem);
    }
    for (std::size_t i = before; i < m_problems.size(); ++i) {
        FieldProblem& found = m_problems[i];
        if (found.node >= 0) {
            found.offset = node(found.node).offset;
            found.length = node(found.node).length;
        }
        found.text = i == before ? found.text : QString(); // the first of a kind speaks for all
    }
}

void FieldDocument::markNodes() {
    m_own.assign(m_tree.nodes.size(), Health::Unknown);
    for (const FieldProblem& problem : m_problems) {
        if (problem.node >= 0) {
            m_own[at(problem.node)] = worse(m_own[at(problem.node)], problem.level);
        }
    }
    m_within = m_own;
    for (std::size_t i = m_tree.nodes.size(); i-- > 0;) {
        if (const std::int32_t parent = m_tree.nodes[i].parent; parent >= 0) {
            m_within[at(parent)] = worse(m_within[at(parent)], m_within[i]);
        }
    }
}

bool FieldDocument::hasSameRows(const FieldDocument& other) const {
    return std::ranges::equal(m_tree.nodes, other.m_tree.nodes, [](const FieldNode& a, const FieldNode& b) {
        return a.parent == b.parent && a.kind == b.kind && a.offset == b.offset && a.name == b.name;
    });
}

} // namespace posewire::gui
