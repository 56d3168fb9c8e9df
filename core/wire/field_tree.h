// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/codec.h"

#include <optional>

namespace posewire::wire {

/// One row of the inspector: a field, a list or an item, with the bytes it stands on.
struct FieldNode {
    std::string name;
    std::string value; ///< the wire's own value as text; empty for lists and items
    std::uint32_t offset = 0;
    std::uint32_t length = 0;
    std::int32_t parent = -1; ///< index of the parent in FieldTree::nodes, -1 at the top
    Unit unit = Unit::None;
    std::string_view text;    ///< one line of documentation
    std::string_view section; ///< of the specification
};

/// Every field of a datagram in wire order, parents before their children. A datagram with a fault has
/// everything up to it.
struct FieldTree {
    std::vector<FieldNode> nodes;
    std::vector<Notice> notices;
    std::optional<WireError> fault;

    /// The innermost node on the byte at `offset`; -1 where there is none.
    [[nodiscard]] std::int32_t nodeAt(std::uint32_t offset) const;
};

[[nodiscard]] FieldTree fieldTree(Bytes bytes);

} // namespace posewire::wire
