// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/field_document.h"

#include "app/gui/models/field_text.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/body/item_names.h"
#include "core/model/body/joint_angles.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace posewire::gui {

namespace {

using wire::FieldNode;
using wire::NodeKind;
using wire::RefersTo;

constexpr std::int32_t kNone = -1;

Health worse(Health a, Health b) {
    const auto rank = [](Health health) {
        return health == Health::Error ? 2 : health == Health::Warning ? 1 : 0;
    };
    return rank(b) > rank(a) ? b : a;
}

/// "Segment 16 · Left Upper Leg · Orientation".
QString place(const FieldDocument& document, std::int32_t node) {
    const std::int32_t item = document.itemOf(node);
    const QString field = fieldTitle(document, node);
    return item < 0 || item == node ? field : fieldTitle(document, item) + QStringLiteral(" · ") + field;
}

QString cutText(const FieldDocument& document) {
    const wire::FieldTree& tree = document.tree;
    const wire::WireError& error = tree.cutError;
    if (tree.cutNode < 0) {
        return {};
    }
    const QString where = place(document, tree.cutNode);
    const auto length = static_cast<std::int32_t>(error.need);
    switch (error.code) {
    case wire::ErrorCode::FieldTruncated:
        return error.have == 0 ? tr("%1 needs %2 bytes, none is left").arg(where, grouped(error.need))
                               : tr("%1 needs %2 bytes, %3 are there")
                                     .arg(where, grouped(error.need), grouped(error.have));
    case wire::ErrorCode::BadLength:
        return length < 0 ? tr("the length of %1 is negative (%2)").arg(where).arg(length)
                          : tr("%1 is announced with %2 bytes, %3 are left")
                                .arg(where, grouped(error.need), grouped(error.have));
    case wire::ErrorCode::CountTooLarge:
        return tr("%1 is %2, at most %3 can be here").arg(where, grouped(error.need), grouped(error.have));
    case wire::ErrorCode::BadSequence:
        return tr("%1 is not UTF-8").arg(where);
    case wire::ErrorCode::UnterminatedText:
        return tr("%1 has no terminating zero byte").arg(where);
    default:
        return {};
    }
}

QString datagramText(const FieldDocument& document) {
    const wire::WireError& fault = *document.tree.fault;
    const QString size = grouped(document.bytes.size());
    switch (fault.code) {
    case wire::ErrorCode::HeaderTruncated:
        return tr("the datagram ends at byte %1, within its header of 24").arg(size);
    case wire::ErrorCode::PayloadTruncated:
        return tr("the datagram ends at byte %1, its header announces %2").arg(size, grouped(fault.need));
    case wire::ErrorCode::ItemsTruncated:
        return tr("the %1 announced items do not fit, %2 bytes are missing")
            .arg(grouped(document.header.items), grouped(fault.need - fault.have));
    case wire::ErrorCode::BadType:
        return tr("MXTP is not followed by two digits");
    case wire::ErrorCode::TooLong:
        return tr("longer than any datagram can be");
    default:
        return {};
    }
}

QString faultText(const FieldDocument& document) {
    const QString whole = datagramText(document);
    const QString near = cutText(document);
    const std::int32_t cut = document.tree.cutNode;
    const std::uint32_t offset = cut >= 0 ? document.node(cut).offset : document.tree.fault->offset;
    const QString both = whole.isEmpty() || near.isEmpty() ? whole + near : tr("%1; %2").arg(whole, near);
    return tr("malformed: %1 (byte %2)").arg(both, grouped(offset));
}

QString outsideText(const FieldDocument& document) {
    return document.kind == model::PacketKind::Skipped
               ? tr("skipped: bytes of a byte stream that belong to no datagram")
               : tr("foreign: does not begin with MXTP, so no sender of motion capture data sent this");
}

} // namespace

FieldDocument::FieldDocument(const log::Packet& packet, model::LengthUnit lengthUnit, bool sentYUp)
    : bytes(packet.bytes.begin(), packet.bytes.end()),
      number(packet.number),
      stamp(packet.stamp),
      sender(packet.sender),
      unit(lengthUnit),
      isYUp(sentYUp) {
    if (packet.flags.skipped) {
        kind = model::PacketKind::Skipped;
        FieldNode& rest = tree.nodes.emplace_back();
        rest.name = "unread";
        rest.kind = NodeKind::Unread;
        rest.length = static_cast<std::uint32_t>(bytes.size());
    } else {
        tree = wire::fieldTree(bytes, wire::FieldDetail::Parts);
        kind = !wire::startsWithMagic(bytes) ? model::PacketKind::Foreign
               : tree.fault                  ? model::PacketKind::Malformed
                                             : model::PacketKind::Datagram;
    }
    if (const auto read = wire::decodeHeader(bytes); read && !packet.flags.skipped) {
        hasHeader = true;
        header = *read;
    }
    m_children.resize(tree.nodes.size() + 1);
    for (std::int32_t i = 0; i < count(); ++i) {
        m_children[nodeIndex(node(i).parent + 1)].push_back(i);
    }
    readContext();
    findProblems(packet);
    markNodes();
}

void FieldDocument::readContext() {
    std::vector<std::uint32_t> ids;
    std::size_t items = 0;
    std::int32_t first = kNone;
    for (const std::int32_t top : children(kNone)) {
        if (node(top).kind != NodeKind::Group || isInHeader(top)) {
            continue;
        }
        items = std::max<std::size_t>(items, node(top).index);
        first = first < 0 && !children(top).empty() ? children(top).front() : first;
        for (const std::int32_t item : children(top)) {
            if (const auto id = numberOf(item, RefersTo::Point)) {
                ids.push_back(*id);
            }
        }
    }
    const RefersTo about = first >= 0 ? node(first).refersTo : RefersTo::Nothing;
    m_places = model::itemPlaces(header, std::min<std::size_t>(items, wire::kMaxItems),
                                 first >= 0 ? numberOf(first, about) : std::nullopt);
    if (about == RefersTo::Joint && header.datagramIndex() != 0) {
        m_places.first = firstJoint(first);
    }
    if (!ids.empty()) {
        m_coding = model::detectPointIdCoding(ids);
    }
}

/// By its two ends.
std::optional<int> FieldDocument::firstJoint(std::int32_t item) const {
    std::vector<std::uint32_t> ends;
    for (const std::int32_t child : children(item)) {
        if (node(child).refersTo == RefersTo::JointEnd && std::isfinite(node(child).number)) {
            ends.push_back(static_cast<std::uint32_t>(node(child).number));
        }
    }
    return ends.size() == 2 ? model::findJoint(ends[0], ends[1]) : std::nullopt;
}

int FieldDocument::placeOf(std::int32_t item) const {
    return m_places.first ? *m_places.first + static_cast<int>(node(item).index) : -1;
}

std::string FieldDocument::lastingPath(std::int32_t node) const {
    const std::int32_t item = itemOf(node);
    const std::string path = tree.path(node);
    if (item < 0) {
        return path;
    }
    const RefersTo about = this->node(item).refersTo;
    const bool hasPlace =
        about == RefersTo::Segment || about == RefersTo::UnitySegment || about == RefersTo::Joint;
    const auto id = hasPlace ? std::nullopt : numberOf(item, about);
    if (!id && placeOf(item) < 0) {
        return path;
    }
    const std::string own = id ? '#' + std::to_string(*id) : std::to_string(placeOf(item));
    return tree.path(this->node(item).parent) + '[' + own + ']' + path.substr(tree.path(item).size());
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

std::span<const std::int32_t> FieldDocument::children(std::int32_t node) const {
    return m_children.empty() ? std::span<const std::int32_t>() : m_children[nodeIndex(node + 1)];
}

std::int32_t FieldDocument::itemOf(std::int32_t node) const {
    while (node >= 0 && this->node(node).kind != NodeKind::Item) {
        node = this->node(node).parent;
    }
    return node;
}

std::int32_t FieldDocument::nodeAt(std::uint32_t offset) const {
    const std::int32_t found = tree.nodeAt(offset);
    const bool isBits = found >= 0 && node(found).kind == NodeKind::Part && node(found).parent >= 0 &&
                        node(node(found).parent).length == node(found).length;
    return isBits ? node(found).parent : found;
}

std::int32_t FieldDocument::find(const std::string& path) const {
    // From the top down: only nodes beside the way have their path built.
    std::int32_t around = kNone;
    for (bool isDeeper = true; isDeeper;) {
        isDeeper = false;
        for (const std::int32_t child : children(around)) {
            const std::string begin = tree.path(child);
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

bool FieldDocument::isTag(std::int32_t item) const {
    if (node(item).index < model::kBodySegments || type() > wire::PoseQuaternion::kType) {
        return false;
    }
    const auto datagram = wire::decode(bytes);
    return datagram && model::isTag(*datagram, node(item).index);
}

int FieldDocument::segmentOf(std::int32_t node) const {
    const std::int32_t item = itemOf(node);
    if (item < 0 || isTag(item)) {
        return -1;
    }
    const int index = placeOf(item);
    const bool isOfBody = index >= 0 && index < model::kBodySegmentCount;
    const auto carrier = [&](RefersTo what) {
        return static_cast<int>(std::min(numberOf(item, what).value_or(0), 1'000'000U)) - 1;
    };
    switch (this->node(item).refersTo) {
    case RefersTo::Segment:
        return m_places.positionOf(this->node(item).index, numberOf(item, RefersTo::Segment));
    case RefersTo::UnitySegment:
        return isOfBody ? model::unityOrder()[static_cast<std::size_t>(index)] : -1;
    case RefersTo::Joint:
        return index >= 0 && index < model::kJointCount
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

std::string_view FieldDocument::segmentTitle(std::int32_t item) const {
    const RefersTo about = node(item).refersTo;
    const std::uint32_t id = numberOf(item, about).value_or(0);
    const bool isOfBody = id >= 1 && id <= static_cast<std::uint32_t>(model::kBodySegmentCount);
    return model::segmentTitle(isOfBody ? model::SegmentLayout() : m_places.layout, segmentOf(item));
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
    const auto whole = static_cast<std::uint32_t>(bytes.size());
    if (kind == model::PacketKind::Skipped || kind == model::PacketKind::Foreign) {
        problems.push_back({Health::Error, outsideText(*this), 0, whole, count() > 0 ? 0 : -1});
        return;
    }
    if (packet.flags.truncated) {
        const QString text = tr("longer than what could be received: only the first %1 bytes are here");
        addProblem(Health::Error, text.arg(grouped(whole)), kNone, whole);
    }
    if (tree.fault) {
        addFault();
    }
    if (packet.flags.shared != 0) {
        addProblem(Health::Warning, said(words::sharedFact(packet.flags.shared), words::Form::Sentence),
                   kNone, whole);
    }
    for (const wire::Notice& notice : tree.notices) {
        addNotice(notice);
    }
}

void FieldDocument::addProblem(Health level, const QString& text, std::int32_t index, std::uint32_t offset) {
    if (index < 0) {
        problems.push_back({level, text, offset, 0, kNone});
    } else {
        problems.push_back({level, text, node(index).offset, node(index).length, index});
    }
}

void FieldDocument::addFault() {
    addProblem(Health::Error, faultText(*this), tree.cutNode, tree.fault->offset);
    if (const FieldNode& rest = tree.nodes.back(); rest.kind == NodeKind::Unread) {
        const QString text = tr("%1 bytes from byte %2 are unread");
        addProblem(Health::Unknown, text.arg(grouped(rest.length), grouped(rest.offset)), count() - 1);
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
    QString text = faultText(notice);
    for (std::int32_t i = 0; i < count(); ++i) {
        if (isAffected(notice.code, i)) {
            addProblem(Health::Warning, std::exchange(text, {}), i); // the first of a kind speaks for all
        }
    }
    if (!text.isEmpty()) {
        addProblem(Health::Warning, text, nodeAt(notice.offset), notice.offset);
    }
}

void FieldDocument::markNodes() {
    m_own.assign(tree.nodes.size(), Health::Unknown);
    for (const FieldProblem& problem : problems) {
        if (problem.node >= 0) {
            m_own[nodeIndex(problem.node)] = worse(m_own[nodeIndex(problem.node)], problem.level);
        }
    }
    m_within = m_own;
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
        if (const std::int32_t parent = tree.nodes[i].parent; parent >= 0) {
            m_within[nodeIndex(parent)] = worse(m_within[nodeIndex(parent)], m_within[i]);
        }
    }
}

bool FieldDocument::hasSameRows(const FieldDocument& other) const {
    return std::ranges::equal(tree.nodes, other.tree.nodes, [](const FieldNode& a, const FieldNode& b) {
        return a.parent == b.parent && a.kind == b.kind && a.offset == b.offset && a.name == b.name;
    });
}

} // namespace posewire::gui
