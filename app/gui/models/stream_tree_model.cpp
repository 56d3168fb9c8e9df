// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/stream_tree_model.h"

#include "app/gui/models/shown_character.h"
#include "core/wire/type_table.h"

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr int kNone = -1;

} // namespace

model::CharacterKey characterOf(const log::StreamKey& key) {
    return {key.sender, key.character};
}

StreamTreeModel::StreamTreeModel(model::SessionView& view, std::vector<TableColumn<StreamRow>> columns,
                                 QObject* parent)
    : ColumnModel(std::move(columns), parent), m_view(view) {}

void StreamTreeModel::insertNew() {
    nodesOf(Kind::Sender).resize(m_view.senders().size(), kNone);
    nodesOf(Kind::Character).resize(m_view.characters().size(), kNone);
    nodesOf(Kind::Stream).resize(m_view.streams().size(), kNone);
    if (!insert(Kind::Sender) && !insert(Kind::Character)) {
        insert(Kind::Stream);
    }
}

bool StreamTreeModel::insert(Kind kind) {
    std::optional<int> parent;
    std::vector<std::size_t> entries;
    for (std::size_t entry = 0; entry < nodesOf(kind).size(); ++entry) {
        const auto wanted = nodesOf(kind)[entry] == kNone ? parentOf(kind, entry) : std::nullopt;
        if (wanted && (!parent || parent == wanted)) {
            parent = wanted;
            entries.push_back(entry);
        }
    }
    if (entries.empty()) {
        return false;
    }
    const int first = static_cast<int>(childrenOf(*parent).size());
    beginInsertRows(indexOfNode(*parent), first, first + static_cast<int>(entries.size()) - 1);
    for (const std::size_t entry : entries) {
        addNode(kind, entry, *parent);
    }
    endInsertRows();
    return true;
}

void StreamTreeModel::addNode(Kind kind, std::size_t entry, int parent) {
    const int node = static_cast<int>(m_nodes.size());
    std::vector<int>& siblings = childrenOf(parent);
    const int row = static_cast<int>(siblings.size());
    siblings.push_back(node);
    m_nodes.push_back({kind, entry, parent, row, {}});
    nodesOf(kind)[entry] = node;
    if (kind == Kind::Stream) {
        return;
    }
    const Kind below = kind == Kind::Sender ? Kind::Character : Kind::Stream;
    for (std::size_t child = 0; child < nodesOf(below).size(); ++child) {
        if (nodesOf(below)[child] == kNone && parentOf(below, child) == node) {
            addNode(below, child, node);
        }
    }
}

std::optional<int> StreamTreeModel::parentOf(Kind kind, std::size_t entry) const {
    int parent = kNone;
    if (kind == Kind::Sender) {
        return kNone;
    }
    if (kind == Kind::Character) {
        const auto& senders = m_view.senders();
        const auto found =
            std::ranges::find(senders, m_view.characters()[entry].key.sender, &model::Sender::id);
        if (found != senders.end()) {
            parent = nodesOf(Kind::Sender)[static_cast<std::size_t>(found - senders.begin())];
        }
    } else if (const auto* character = m_view.find(characterOf(m_view.streams()[entry].key))) {
        parent = nodesOf(Kind::Character)[character->ordinal];
    }
    return parent == kNone ? std::nullopt : std::optional(parent);
}

const StreamTreeModel::Node& StreamTreeModel::nodeOf(const QModelIndex& index) const {
    return m_nodes[static_cast<std::size_t>(index.internalId())];
}

QModelIndex StreamTreeModel::indexOfNode(int node) const {
    return node == kNone ? QModelIndex()
                         : createIndex(m_nodes[static_cast<std::size_t>(node)].row, 0,
                                       static_cast<quintptr>(static_cast<unsigned>(node)));
}

QModelIndex StreamTreeModel::indexOf(const Node& node) const {
    return index(node.row, 0, indexOfNode(node.parent));
}

QString StreamTreeModel::nameOf(const StreamRow& row) const {
    switch (row.kind) {
    case Kind::Sender:
        return QString::fromStdString(m_view.senders()[row.entry].info.address);
    case Kind::Character:
        return characterName(m_view, m_view.characters()[row.entry].key);
    case Kind::Stream:
        break;
    }
    return QString::fromStdString(wire::typeTitle(m_view.streams()[row.entry].key.type));
}

QVariant StreamTreeModel::marksOf(const StreamRow& row, int role) const {
    if (row.kind != Kind::Character || (role != kSuffixRole && role != kDotRole)) {
        return {};
    }
    const model::CharacterKey& key = m_view.characters()[row.entry].key;
    return role == kSuffixRole ? QVariant(QStringLiteral("· %1").arg(key.character))
                               : characterColour(m_view, key);
}

std::optional<model::CharacterKey> StreamTreeModel::character(const QModelIndex& index) const {
    if (!index.isValid() || nodeOf(index).kind == Kind::Sender) {
        return std::nullopt;
    }
    const Node& node = nodeOf(index);
    return node.kind == Kind::Character ? m_view.characters()[node.entry].key
                                        : characterOf(m_view.streams()[node.entry].key);
}

std::optional<log::SenderId> StreamTreeModel::sender(const QModelIndex& index) const {
    if (!index.isValid()) {
        return std::nullopt;
    }
    const auto key = character(index);
    return key ? key->sender : m_view.senders()[nodeOf(index).entry].id;
}

const model::Stream* StreamTreeModel::stream(const QModelIndex& index) const {
    const bool isStream = index.isValid() && nodeOf(index).kind == Kind::Stream;
    return isStream ? &m_view.streams()[nodeOf(index).entry] : nullptr;
}

QModelIndex StreamTreeModel::indexOf(const model::CharacterKey& key) const {
    const model::Character* found = m_view.find(key);
    const std::vector<int>& nodes = nodesOf(Kind::Character);
    return found == nullptr || found->ordinal >= nodes.size() ? QModelIndex()
                                                              : indexOfNode(nodes[found->ordinal]);
}

QModelIndex StreamTreeModel::index(int row, int column, const QModelIndex& parent) const {
    if (!hasIndex(row, column, parent)) {
        return {};
    }
    const std::vector<int>& children = parent.isValid() ? nodeOf(parent).children : m_roots;
    return createIndex(row, column,
                       static_cast<quintptr>(static_cast<unsigned>(children[static_cast<std::size_t>(row)])));
}

QModelIndex StreamTreeModel::parent(const QModelIndex& index) const {
    return index.isValid() ? indexOfNode(nodeOf(index).parent) : QModelIndex();
}

int StreamTreeModel::rowCount(const QModelIndex& parent) const {
    if (!parent.isValid()) {
        return static_cast<int>(m_roots.size());
    }
    return parent.column() == 0 ? static_cast<int>(nodeOf(parent).children.size()) : 0;
}

QVariant StreamTreeModel::data(const QModelIndex& index, int role) const {
    return checkIndex(index, CheckIndexOption::IndexIsValid) ? cell(nodeOf(index), index.column(), role)
                                                             : QVariant();
}

} // namespace posewire::gui
