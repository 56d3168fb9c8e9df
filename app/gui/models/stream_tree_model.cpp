// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/stream_tree_model.h"

#include <algorithm>

namespace posewire::gui {

namespace {

constexpr int kNone = -1;

model::CharacterKey characterOf(const log::StreamKey& key) {
    return {key.sender, key.character};
}

} // namespace

StreamTreeModel::StreamTreeModel(model::SessionView& view, std::vector<TableColumn<StreamRow>> columns,
                                 QObject* parent)
    : ColumnModel(std::move(columns), parent), m_view(view) {}

void StreamTreeModel::insertNew() {
    m_senderNodes.resize(m_view.senders().size(), kNone);
    m_characterNodes.resize(m_view.characters().size(), kNone);
    m_streamNodes.resize(m_view.streams().size(), kNone);
    if (!insertSenders() && !insertCharacters()) {
        insertStreams();
    }
}

bool StreamTreeModel::insertSenders() {
    const std::size_t first = m_roots.size();
    const std::size_t end = m_senderNodes.size();
    if (first == end) {
        return false;
    }
    beginInsertRows({}, static_cast<int>(first), static_cast<int>(end) - 1);
    for (std::size_t entry = first; entry < end; ++entry) {
        addSender(entry);
    }
    endInsertRows();
    return true;
}

bool StreamTreeModel::insertCharacters() {
    return insertChildren(m_characterNodes, &StreamTreeModel::parentOfCharacter,
                          &StreamTreeModel::addCharacter);
}

bool StreamTreeModel::insertStreams() {
    return insertChildren(m_streamNodes, &StreamTreeModel::parentOfStream, &StreamTreeModel::addStream);
}

bool StreamTreeModel::insertChildren(const std::vector<int>& nodes,
                                     int (StreamTreeModel::*parentOf)(std::size_t) const,
                                     void (StreamTreeModel::*add)(std::size_t, int)) {
    int parent = kNone;
    std::vector<std::size_t> entries;
    for (std::size_t entry = 0; entry < nodes.size(); ++entry) {
        const int wanted = nodes[entry] == kNone ? (this->*parentOf)(entry) : kNone;
        if (wanted != kNone && (parent == kNone || parent == wanted)) {
            parent = wanted;
            entries.push_back(entry);
        }
    }
    if (entries.empty()) {
        return false;
    }
    const int first = static_cast<int>(m_nodes[static_cast<std::size_t>(parent)].children.size());
    beginInsertRows(indexOfNode(parent), first, first + static_cast<int>(entries.size()) - 1);
    for (const std::size_t entry : entries) {
        (this->*add)(entry, parent);
    }
    endInsertRows();
    return true;
}

int StreamTreeModel::addNode(Kind kind, std::size_t entry, int parent) {
    const int node = static_cast<int>(m_nodes.size());
    std::vector<int>& siblings =
        parent == kNone ? m_roots : m_nodes[static_cast<std::size_t>(parent)].children;
    const int row = static_cast<int>(siblings.size());
    siblings.push_back(node);
    m_nodes.push_back({kind, entry, parent, row, {}});
    return node;
}

void StreamTreeModel::addSender(std::size_t entry) {
    m_senderNodes[entry] = addNode(Kind::Sender, entry, kNone);
    for (std::size_t i = 0; i < m_characterNodes.size(); ++i) {
        if (m_characterNodes[i] == kNone && m_view.characters()[i].key.sender == m_view.senders()[entry].id) {
            addCharacter(i, m_senderNodes[entry]);
        }
    }
}

void StreamTreeModel::addCharacter(std::size_t entry, int parent) {
    m_characterNodes[entry] = addNode(Kind::Character, entry, parent);
    for (std::size_t i = 0; i < m_streamNodes.size(); ++i) {
        if (m_streamNodes[i] == kNone &&
            characterOf(m_view.streams()[i].key) == m_view.characters()[entry].key) {
            addStream(i, m_characterNodes[entry]);
        }
    }
}

void StreamTreeModel::addStream(std::size_t entry, int parent) {
    m_streamNodes[entry] = addNode(Kind::Stream, entry, parent);
}

const StreamTreeModel::Node& StreamTreeModel::nodeOf(const QModelIndex& index) const {
    return m_nodes[static_cast<std::size_t>(index.internalId())];
}

QModelIndex StreamTreeModel::indexOfNode(int node) const {
    return node == kNone ? QModelIndex()
                         : createIndex(m_nodes[static_cast<std::size_t>(node)].row, 0,
                                       static_cast<quintptr>(static_cast<unsigned>(node)));
}

int StreamTreeModel::parentOfCharacter(std::size_t entry) const {
    const log::SenderId sender = m_view.characters()[entry].key.sender;
    const auto found = std::ranges::find(m_view.senders(), sender, &model::Sender::id);
    return found == m_view.senders().end()
               ? kNone
               : m_senderNodes[static_cast<std::size_t>(found - m_view.senders().begin())];
}

int StreamTreeModel::parentOfStream(std::size_t entry) const {
    const model::Character* character = m_view.find(characterOf(m_view.streams()[entry].key));
    return character == nullptr ? kNone : m_characterNodes[character->ordinal];
}

std::optional<model::CharacterKey> StreamTreeModel::character(const QModelIndex& index) const {
    if (!index.isValid()) {
        return std::nullopt;
    }
    const Node& node = nodeOf(index);
    switch (node.kind) {
    case Kind::Character:
        return m_view.characters()[node.entry].key;
    case Kind::Stream:
        return characterOf(m_view.streams()[node.entry].key);
    case Kind::Sender:
        break;
    }
    return std::nullopt;
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
    return found == nullptr || found->ordinal >= m_characterNodes.size()
               ? QModelIndex()
               : indexOfNode(m_characterNodes[found->ordinal]);
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
