// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/codec.h"
#include "core/wire/field.h"

#include <limits>
#include <optional>

namespace posewire::wire {

enum class NodeKind : std::uint8_t {
    Field,
    Group, ///< header, list
    Item,
    Part,   ///< a component of a vector, a length, bits: inside a Field
    Cut,    ///< the field for which the bytes did not suffice
    Unread, ///< bytes after a fault, or bytes of no field
};

/// One row of the inspector: a field, a list or an item, with its bytes.
struct FieldNode {
    std::string name;
    std::string value; ///< the wire's own value as text; empty for lists and items
    std::uint32_t offset = 0;
    std::uint32_t length = 0;
    std::int32_t parent = -1; ///< index of the parent in FieldTree::nodes, -1 at the top
    Unit unit = Unit::None;
    NodeKind kind = NodeKind::Field;
    RefersTo refersTo = RefersTo::Nothing; ///< as declared; of an item what its list is about
    Scalar scalar = Scalar::Text;          ///< what the bytes of a value or of its part are
    std::uint8_t components = 0;           ///< of a vector: how many parts follow, with FieldDetail::Parts
    std::uint32_t index = 0; ///< of an item in its list, from 0; of a list: how many are announced
    double number = std::numeric_limits<double>::quiet_NaN(); ///< of one numeric value
    std::string_view text;                                    ///< one line of documentation
    std::string_view section;                                 ///< of the specification
};

enum class FieldDetail : std::uint8_t {
    Fields, ///< each leaf is a field; every byte has one leaf
    Parts,  ///< vectors, texts and bit fields are divided; what a fault cuts off and leaves unread is there
};

/// Every field of a datagram in wire order, parents before their children. A datagram with a fault has
/// everything up to it.
struct FieldTree {
    std::vector<FieldNode> nodes;
    std::vector<Notice> notices;
    std::optional<WireError> fault;

    /// The field that reading ended in, with FieldDetail::Parts; -1 if there is none. `cutError` says what
    /// it lacked: it can be nearer to the cause than `fault`, which is about the datagram.
    std::int32_t cutNode = -1;
    WireError cutError;

    /// The innermost node on the byte at `offset`; -1 if there is none.
    [[nodiscard]] std::int32_t nodeAt(std::uint32_t offset) const;

    /// "segments[6].position.z", unique within a datagram and the same in every datagram of a type.
    [[nodiscard]] std::string path(std::int32_t node) const;
};

[[nodiscard]] FieldTree fieldTree(Bytes bytes, FieldDetail detail = FieldDetail::Fields);

} // namespace posewire::wire
