// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/column.h"

#include <QAbstractItemModel>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace posewire::gui {

/// A tree whose rows come and go by keys.
template <class Row>
class KeyedTreeModel : public ColumnModel<Row, QAbstractItemModel> {
protected:
    using ColumnModel<Row, QAbstractItemModel>::ColumnModel;

    /// Makes the keys that are shown below a row the wanted ones, both sorted, run by run; calls `remove` and
    /// `add` with each key that goes and comes. False, and not all done, if it takes more than `most` runs.
    template <class Key, class Remove, class Add>
    bool mergeRows(const QModelIndex& above, std::vector<Key>& shown, const std::vector<Key>& wanted,
                   std::size_t most, Remove remove, Add add) {
        std::size_t at = 0;
        for (std::size_t runs = 0; shown != wanted; ++runs) {
            if (runs == most) {
                return false;
            }
            while (at < shown.size() && at < wanted.size() && shown[at] == wanted[at]) {
                ++at;
            }
            const bool isGone = at < shown.size() && (at == wanted.size() || shown[at] < wanted[at]);
            const std::vector<Key>& run = isGone ? shown : wanted;
            const std::vector<Key>& other = isGone ? wanted : shown;
            const auto begin = run.begin() + static_cast<std::ptrdiff_t>(at);
            const auto end = at == other.size() ? run.end() : std::lower_bound(begin, run.end(), other[at]);
            const auto last = static_cast<int>(end - run.begin()) - 1;
            if (isGone) {
                this->beginRemoveRows(above, static_cast<int>(at), last);
                std::for_each(begin, end, remove);
                shown.erase(begin, end);
                this->endRemoveRows();
            } else {
                this->beginInsertRows(above, static_cast<int>(at), last);
                std::for_each(begin, end, add);
                shown.insert(shown.begin() + static_cast<std::ptrdiff_t>(at), begin, end);
                this->endInsertRows();
            }
        }
        return true;
    }
};

/// A tree whose rows are nodes, counted from 0, each at the top, which is -1, or below another.
template <class Row>
class TreeModel : public ColumnModel<Row, QAbstractItemModel> {
public:
    /// -1 for an invalid index.
    [[nodiscard]] std::int32_t node(const QModelIndex& index) const {
        return index.isValid() ? static_cast<std::int32_t>(index.internalId()) : -1;
    }
    /// Invalid where the node has no place.
    [[nodiscard]] QModelIndex indexOf(std::int32_t node, int column = 0) const {
        const bool isThere = node >= 0 && slotOf(node) < m_places.size() && m_places[slotOf(node)].row >= 0;
        return isThere ? this->createIndex(m_places[slotOf(node)].row, column, static_cast<quintptr>(node))
                       : QModelIndex();
    }

    [[nodiscard]] QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override {
        return this->hasIndex(row, column, parent)
                   ? indexOf(m_places[slotOf(node(parent))].children[static_cast<std::size_t>(row)], column)
                   : QModelIndex();
    }
    [[nodiscard]] QModelIndex parent(const QModelIndex& index) const override {
        return index.isValid() ? indexOf(m_places[slotOf(node(index))].parent) : QModelIndex();
    }
    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override {
        return parent.column() > 0 ? 0 : static_cast<int>(m_places[slotOf(node(parent))].children.size());
    }

protected:
    using ColumnModel<Row, QAbstractItemModel>::ColumnModel;

    void clearPlaces() { m_places.assign(1, {}); }
    /// As the last row below its parent, which has a place.
    void place(std::int32_t node, std::int32_t parent) {
        place(node, parent, static_cast<int>(m_places[slotOf(parent)].children.size()));
    }
    /// As that row below its parent.
    void place(std::int32_t node, std::int32_t parent, int row) {
        m_places.resize(std::max(m_places.size(), slotOf(node) + 1));
        std::vector<std::int32_t>& siblings = m_places[slotOf(parent)].children;
        m_places[slotOf(node)] = {parent, row, {}};
        siblings.insert(siblings.begin() + row, node);
        for (auto place = static_cast<std::size_t>(row) + 1; place < siblings.size(); ++place) {
            m_places[slotOf(siblings[place])].row = static_cast<int>(place);
        }
    }

private:
    struct Place {
        std::int32_t parent = -1;
        int row = -1; ///< -1 for none
        std::vector<std::int32_t> children{};
    };
    [[nodiscard]] static std::size_t slotOf(std::int32_t node) { return static_cast<std::size_t>(node + 1); }

    std::vector<Place> m_places{1}; ///< of the top, then of each node
};

} // namespace posewire::gui
