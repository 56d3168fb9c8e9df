// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/stream_tree_model.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "core/wire/type_table.h"

#include <algorithm>

namespace posewire::gui {

model::CharacterKey characterOf(const log::StreamKey& key) {
    return {key.sender, key.character};
}

StreamTreeModel::StreamTreeModel(model::SessionView& view, std::vector<TableColumn<StreamRow>> columns,
                                 QObject* parent)
    : TreeModel(std::move(columns), parent), m_view(view) {}

void StreamTreeModel::insertNew() {
    m_nodesOf[Kind::Sender].resize(m_view.senders().size(), kNone);
    m_nodesOf[Kind::Character].resize(m_view.characters().size(), kNone);
    m_nodesOf[Kind::Stream].resize(m_view.streams().size(), kNone);
    if (!insert(Kind::Sender) && !insert(Kind::Character)) {
        insert(Kind::Stream);
    }
}

bool StreamTreeModel::insert(Kind kind) {
    std::optional<int> parent;
    std::vector<std::size_t> entries;
    for (std::size_t entry = 0; entry < m_nodesOf[kind].size(); ++entry) {
        const auto wanted = m_nodesOf[kind][entry] == kNone ? parentOf(kind, entry) : std::nullopt;
        if (wanted && (!parent || parent == wanted)) {
            parent = wanted;
            entries.push_back(entry);
        }
    }
    if (entries.empty()) {
        return false;
    }
    const QModelIndex above = TreeModel::indexOf(*parent);
    const int first = rowCount(above);
    beginInsertRows(above, first, first + static_cast<int>(entries.size()) - 1);
    for (const std::size_t entry : entries) {
        addNode(kind, entry, *parent);
    }
    endInsertRows();
    return true;
}

void StreamTreeModel::addNode(Kind kind, std::size_t entry, int parent) {
    const int node = static_cast<int>(m_rows.size());
    m_rows.push_back({kind, entry});
    place(node, parent);
    m_nodesOf[kind][entry] = node;
    if (kind == Kind::Stream) {
        return;
    }
    const Kind below = kind == Kind::Sender ? Kind::Character : Kind::Stream;
    for (std::size_t child = 0; child < m_nodesOf[below].size(); ++child) {
        if (m_nodesOf[below][child] == kNone && parentOf(below, child) == node) {
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
            parent = m_nodesOf[Kind::Sender][static_cast<std::size_t>(found - senders.begin())];
        }
    } else if (const auto* character = m_view.find(characterOf(m_view.streams()[entry].key))) {
        parent = m_nodesOf[Kind::Character][character->ordinal];
    }
    return parent == kNone ? std::nullopt : std::optional(parent);
}

const StreamRow& StreamTreeModel::rowOf(const QModelIndex& index) const {
    return m_rows[static_cast<std::size_t>(node(index))];
}

QModelIndex StreamTreeModel::indexOf(const StreamRow& row) const {
    return TreeModel::indexOf(m_nodesOf[row.kind][row.entry]);
}

QString StreamTreeModel::nameOf(const StreamRow& row) const {
    if (row.kind == Kind::Sender) {
        return shown(m_view.senders()[row.entry].address());
    }
    if (row.kind == Kind::Character) {
        return characterName(m_view, m_view.characters()[row.entry].key);
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
    if (!index.isValid() || rowOf(index).kind == Kind::Sender) {
        return std::nullopt;
    }
    const auto [kind, entry] = rowOf(index);
    return kind == Kind::Character ? m_view.characters()[entry].key
                                   : characterOf(m_view.streams()[entry].key);
}

std::optional<log::SenderId> StreamTreeModel::sender(const QModelIndex& index) const {
    if (!index.isValid()) {
        return std::nullopt;
    }
    const auto key = character(index);
    return key ? key->sender : m_view.senders()[rowOf(index).entry].id;
}

const model::Stream* StreamTreeModel::stream(const QModelIndex& index) const {
    const bool isStream = index.isValid() && rowOf(index).kind == Kind::Stream;
    return isStream ? &m_view.streams()[rowOf(index).entry] : nullptr;
}

QModelIndex StreamTreeModel::indexOf(const model::CharacterKey& key) const {
    const model::Character* found = m_view.find(key);
    const std::vector<int>& nodes = m_nodesOf[Kind::Character];
    return found == nullptr || found->ordinal >= nodes.size() ? QModelIndex()
                                                              : TreeModel::indexOf(nodes[found->ordinal]);
}

QVariant StreamTreeModel::data(const QModelIndex& index, int role) const {
    return checkIndex(index, CheckIndexOption::IndexIsValid) ? cell(rowOf(index), index.column(), role)
                                                             : QVariant();
}

} // namespace posewire::gui
