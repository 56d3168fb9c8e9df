// SPDX-License-Identifier: MIT
#pragma once

#include "core/filter/condition.h"

#include <vector>

namespace posewire::filter {

/// A compiled filter: a tree of nodes.
struct Program {
    enum class Join : std::uint8_t {
        Condition,
        And,
        Or,
        Not,
        AnyItem, ///< its one child holds for one item of one list
    };
    struct Node {
        Join join = Join::Condition;
        std::uint32_t condition = 0;
        std::vector<std::uint32_t> children;
        bool isOfItems = false; ///< only conditions on items below, and no Not
    };

    std::vector<Condition> conditions;
    std::vector<Node> nodes;
    std::uint32_t root = 0;
    bool needsDatagram = false;

    [[nodiscard]] bool holds(Subject& subject, std::uint32_t node) const;

    std::uint32_t add(Node node) {
        nodes.push_back(std::move(node));
        return static_cast<std::uint32_t>(nodes.size() - 1);
    }

private:
    [[nodiscard]] bool holdsForAnyItem(const wire::Datagram* datagram, std::uint32_t node) const;
    struct ItemAt {
        const wire::Datagram& datagram;
        std::size_t shape;
        std::size_t list;
        std::size_t item;
    };
    [[nodiscard]] bool holdsForItem(const ItemAt& at, std::uint32_t node) const;
};

/// The tree of a text, with its conditions on items gathered under AnyItem.
[[nodiscard]] tl::expected<Program, FilterError> parsed(std::string_view text);

} // namespace posewire::filter
