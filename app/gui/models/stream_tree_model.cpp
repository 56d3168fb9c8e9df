// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/stream_tree_model.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "core/model/session/accounts.h"

#include <algorithm>

namespace posewire::gui {

model::CharacterKey characterOf(const log::StreamKey& key) {
    return {key.sender, key.character};
}

namespace {

StreamRow characterRow(const model::CharacterKey& key) {
    return {StreamRow::Character, {key.sender, key.character, 0}};
}

} // namespace

bool StreamTreeModel::insertNew() {
    const std::uint64_t retired = m_view.accounts().retired().senders;
    if (m_retired == retired) {
        if (!insert(Kind::Sender) && !insert(Kind::Character)) {
            insertStreams();
        }
        return false;
    }
    m_retired = retired;
    beginResetModel();
    m_rows.clear();
    m_nodes = {};
    clearPlaces();
    for (const StreamRow& row : rowsWithout(Kind::Sender)) {
        addNode(row, kNone);
    }
    endResetModel();
    return true;
}

/// All rows of a kind that have no node yet.
std::vector<StreamRow> StreamTreeModel::rowsWithout(Kind kind) const {
    std::vector<StreamRow> rows;
    const auto add = [&](const StreamRow& row) {
        if (!m_nodes[kind].contains(row.key)) {
            rows.push_back(row);
        }
    };
    if (kind == Kind::Sender) {
        for (const model::Sender& sender : m_view.roster().senders()) {
            add({kind, {sender.id, 0, 0}});
        }
    } else if (kind == Kind::Character) {
        for (const model::Character& character : m_view.roster().characters()) {
            if (character.isConfirmed) {
                add(characterRow(character.key));
            }
        }
    } else {
        for (const model::Stream& stream : m_view.roster().streams()) {
            add({kind, stream.key});
        }
    }
    return rows;
}

bool StreamTreeModel::insert(Kind kind) {
    std::vector<StreamRow> rows = rowsWithout(kind);
    std::erase_if(rows, [this](const StreamRow& row) { return !parentOf(row); });
    if (rows.empty()) {
        return false;
    }
    const int parent = *parentOf(rows.front());
    std::erase_if(rows, [&](const StreamRow& row) { return parentOf(row) != parent; });
    const QModelIndex above = TreeModel::indexOf(parent);
    const int first = rowCount(above);
    beginInsertRows(above, first, first + static_cast<int>(rows.size()) - 1);
    for (const StreamRow& row : rows) {
        addNode(row, parent);
    }
    endInsertRows();
    return true;
}

void StreamTreeModel::insertStreams() {
    for (const StreamRow& row : rowsWithout(Kind::Stream)) {
        if (const auto parent = parentOf(row)) {
            const int place = placeBelow(*parent, row);
            beginInsertRows(TreeModel::indexOf(*parent), place, place);
            addNode(row, *parent);
            endInsertRows();
        }
    }
}

int StreamTreeModel::placeBelow(int parent, const StreamRow& row) const {
    const QModelIndex above = TreeModel::indexOf(parent);
    int place = rowCount(above);
    while (row.kind == Kind::Stream && place > 0 &&
           rowOf(index(place - 1, 0, above)).key.type > row.key.type) {
        --place;
    }
    return place;
}

void StreamTreeModel::addNode(const StreamRow& row, int parent) {
    const int node = static_cast<int>(m_rows.size());
    const int below = placeBelow(parent, row);
    m_rows.push_back(row);
    m_nodes[row.kind][row.key] = node;
    place(node, parent, below);
    if (row.kind == Kind::Sender) {
        for (const model::Character* character : senderOf(row).characters) {
            if (character->isConfirmed) {
                addNode(characterRow(character->key), node);
            }
        }
    } else if (row.kind == Kind::Character) {
        for (const model::Stream* stream : characterAt(row).streams) {
            addNode({Kind::Stream, stream->key}, node);
        }
    }
}

std::optional<int> StreamTreeModel::parentOf(const StreamRow& row) const {
    if (row.kind == Kind::Sender) {
        return kNone;
    }
    const bool isCharacter = row.kind == Kind::Character;
    const Nodes& above = m_nodes[isCharacter ? Kind::Sender : Kind::Character];
    const auto found = above.find({row.key.sender, isCharacter ? std::uint8_t{0} : row.key.character, 0});
    return found == above.end() ? std::nullopt : std::optional(found->second);
}

/// The session may have retired its sender since the rows were made.
bool StreamTreeModel::isThere(const StreamRow& row) const {
    const model::Roster& roster = m_view.roster();
    return row.kind == Kind::Sender      ? roster.find(row.key.sender) != nullptr
           : row.kind == Kind::Character ? roster.find(characterOf(row.key)) != nullptr
                                         : roster.find(row.key) != nullptr;
}

const StreamRow& StreamTreeModel::rowOf(const QModelIndex& index) const {
    return m_rows[static_cast<std::size_t>(node(index))];
}

QModelIndex StreamTreeModel::indexOf(const StreamRow& row) const {
    const auto found = m_nodes[row.kind].find(row.key);
    return found == m_nodes[row.kind].end() ? QModelIndex() : TreeModel::indexOf(found->second);
}

QString StreamTreeModel::nameOf(const StreamRow& row) const {
    if (row.kind == Kind::Sender) {
        return shown(senderOf(row).address());
    }
    if (row.kind == Kind::Character) {
        return characterName(namesBeside(m_view), characterOf(row.key));
    }
    return typeTitle(row.key.type);
}

bool StreamTreeModel::isEnded(const QModelIndex& index) const {
    if (!index.isValid() || rowOf(index).kind != Kind::Sender) {
        return false;
    }
    const auto& characters = senderOf(rowOf(index)).characters;
    return !characters.empty() && std::ranges::all_of(characters, [this](const auto* character) {
        return m_view.roster().isSuperseded(character->key);
    });
}

QVariant StreamTreeModel::marksOf(const StreamRow& row, int role) const {
    if (row.kind == Kind::Sender) {
        return role == kSuffixRole && isEnded(indexOf(row)) ? QVariant(tr("· ended")) : QVariant();
    }
    if (row.kind != Kind::Character || (role != kSuffixRole && role != kDotRole)) {
        return {};
    }
    const model::CharacterKey key = characterOf(row.key);
    return role == kSuffixRole ? QVariant(QStringLiteral("· %1").arg(key.character))
                               : QVariant::fromValue(characterMark(namesBeside(m_view), key));
}

std::optional<model::CharacterKey> StreamTreeModel::character(const QModelIndex& index) const {
    return index.isValid() && rowOf(index).kind != Kind::Sender ? std::optional(characterOf(rowOf(index).key))
                                                                : std::nullopt;
}

std::optional<log::SenderId> StreamTreeModel::sender(const QModelIndex& index) const {
    return index.isValid() ? std::optional(rowOf(index).key.sender) : std::nullopt;
}

const model::Stream* StreamTreeModel::stream(const QModelIndex& index) const {
    const bool isStream = index.isValid() && rowOf(index).kind == Kind::Stream;
    return isStream ? m_view.roster().find(rowOf(index).key) : nullptr;
}

QVariant StreamTreeModel::data(const QModelIndex& index, int role) const {
    return checkIndex(index, CheckIndexOption::IndexIsValid) && isThere(rowOf(index))
               ? cell(rowOf(index), index.column(), role)
               : QVariant();
}

} // namespace posewire::gui
