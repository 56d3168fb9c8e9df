// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/theme.h"
#include "core/log/packet.h"
#include "core/log/time.h"
#include "core/model/accounting/packet_digest.h"
#include "core/model/body/character_pose.h"
#include "core/model/body/points.h"
#include "core/model/body/segments.h"
#include "core/model/body/units.h"
#include "core/wire/field_tree.h"

#include <QString>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace posewire::gui {

/// Something wrong or odd in a packet, at the bytes where it arose.
struct FieldProblem {
    Health level = Health::Warning; ///< Unknown: a remark
    QString text;
    std::uint32_t offset = 0;
    std::uint32_t length = 0;
    std::int32_t node = -1; ///< of the tree, -1 if it concerns the whole packet
};

inline std::size_t nodeIndex(std::int32_t node) {
    return static_cast<std::size_t>(node);
}

/// One packet taken apart: a copy of its bytes, the tree of its fields with what they need to be explained,
/// and what is wrong with it. Nodes are indices in tree.nodes.
struct FieldDocument {
    FieldDocument() = default;
    /// `lengthUnit` is that of positions in types 02, 21 and 24 of this sender; `sentYUp`: the type is Z-up
    /// by default, and this sender sends it Y-up.
    FieldDocument(const log::Packet& packet, model::LengthUnit lengthUnit, bool sentYUp = false);

    std::vector<std::byte> bytes;
    std::uint64_t number = 0;
    log::Stamp stamp{};
    log::SenderId sender{};
    model::PacketKind kind = model::PacketKind::Datagram;
    bool hasHeader = false;
    wire::Header header;
    model::LengthUnit unit = model::LengthUnit::Metre;
    bool isYUp = false;
    wire::FieldTree tree;
    std::vector<FieldProblem> problems;

    [[nodiscard]] std::uint8_t type() const { return header.type(); }
    [[nodiscard]] const wire::FieldNode& node(std::int32_t index) const {
        return tree.nodes[static_cast<std::size_t>(index)];
    }
    [[nodiscard]] std::int32_t count() const { return static_cast<std::int32_t>(tree.nodes.size()); }
    [[nodiscard]] std::span<const std::int32_t> children(std::int32_t node) const;
    /// The item that a node belongs to (or is); -1 if it is in none.
    [[nodiscard]] std::int32_t itemOf(std::int32_t node) const;
    /// The innermost node on a byte; of those that share it (bits) the whole.
    [[nodiscard]] std::int32_t nodeAt(std::uint32_t offset) const;
    /// The node of that path; -1 if there is none.
    [[nodiscard]] std::int32_t find(const std::string& path) const;

    [[nodiscard]] bool isInHeader(std::int32_t node) const;
    /// The number of the item's field that refers to `what`; nothing if there is none or it is cut off.
    [[nodiscard]] std::optional<std::uint32_t> numberOf(std::int32_t item, wire::RefersTo what) const;
    /// The point that an id of this datagram names; nothing for tags.
    [[nodiscard]] std::optional<model::PointReference> pointOf(std::uint32_t id) const {
        return model::knownPoint(m_coding, id);
    }

    /// Index of an item in its message, from 0; a sample may come in several datagrams. -1 if not known.
    [[nodiscard]] int placeOf(std::int32_t item) const;
    /// What a node is called in every datagram that has it, whatever part of the sample that is.
    [[nodiscard]] std::string lastingPath(std::int32_t node) const;

    /// True if an item is a MotionGrid tag in the place of a prop.
    [[nodiscard]] bool isTag(std::int32_t item) const;
    /// Position in a pose datagram of the segment that a node is about, -1 if it is about none.
    [[nodiscard]] int segmentOf(std::int32_t node) const;
    /// The item about a segment; -1 if there is none.
    [[nodiscard]] std::int32_t nodeOfSegment(int segment) const;
    /// "Right Upper Arm": what the segment of an item is called; empty if it has no name.
    [[nodiscard]] std::string_view segmentTitle(std::int32_t item) const;

    /// The worst that is wrong with the node itself, and with what is below it.
    [[nodiscard]] Health health(std::int32_t node) const { return m_own[static_cast<std::size_t>(node)]; }
    [[nodiscard]] Health worstWithin(std::int32_t node) const {
        return m_within[static_cast<std::size_t>(node)];
    }

    /// Same fields on the same bytes: rows of a table can stay.
    [[nodiscard]] bool hasSameRows(const FieldDocument& other) const;

private:
    void readContext();
    [[nodiscard]] std::optional<int> firstJoint(std::int32_t item) const;
    void findProblems(const log::Packet& packet);
    void addFault();
    void addNotice(const wire::Notice& notice);
    /// At a node; -1 for none, then at an offset.
    void addProblem(Health level, const QString& text, std::int32_t node, std::uint32_t offset = 0);
    void markNodes();
    [[nodiscard]] bool isAffected(wire::NoticeCode code, std::int32_t node) const;

    model::PointIdCoding m_coding = model::PointIdCoding::By256;
    model::ItemPlaces m_places;                        ///< of the items of its first list
    std::vector<std::vector<std::int32_t>> m_children; ///< in wire order; the first element is of the top
    std::vector<Health> m_own;
    std::vector<Health> m_within;
};

} // namespace posewire::gui
