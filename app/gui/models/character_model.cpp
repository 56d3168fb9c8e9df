// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/character_model.h"

#include "app/gui/models/columns.h"
#include "app/gui/models/roles.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/stream_state.h"
#include "app/gui/models/text.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <array>

namespace posewire::gui {

namespace {

constexpr int kNone = -1;

model::CharacterKey characterOf(const log::StreamKey& key) {
    return {key.source, key.character};
}

QString transportName(log::Transport transport) {
    switch (transport) {
    case log::Transport::Udp:
        return QStringLiteral("UDP");
    case log::Transport::Tcp:
        return QStringLiteral("TCP");
    case log::Transport::File:
        return CharacterModel::tr("file");
    case log::Transport::Performer:
        return CharacterModel::tr("demo");
    }
    return {};
}

/// What tells how fast a character comes: its pose, or else the fastest of its streams.
const model::Stream* leadingStream(model::SessionView& view, const model::CharacterKey& key) {
    for (const std::uint8_t type : std::array<std::uint8_t, 3>{2, 1, 5}) {
        if (const auto* stream = view.find(log::StreamKey{key.source, key.character, type})) {
            return stream;
        }
    }
    const model::Stream* fastest = nullptr;
    for (const model::Stream& stream : view.streams()) {
        if (characterOf(stream.key) == key && wire::isSampled(stream.key.type) &&
            (fastest == nullptr || stream.statistics.rateHz() > fastest->statistics.rateHz())) {
            fastest = &stream;
        }
    }
    return fastest;
}

QVariant stateData(const State& state, int role) {
    switch (role) {
    case Qt::DisplayRole:
        return state.display();
    case Qt::ForegroundRole:
        return healthColour(state.health);
    default:
        return role == Qt::TextAlignmentRole ? numberAlignment() : QVariant();
    }
}

} // namespace

CharacterModel::CharacterModel(model::SessionView& view, Commands& commands, QObject* parent)
    : QAbstractItemModel(parent), m_view(view), m_commands(commands) {}

void CharacterModel::refresh() {
    m_sourceNodes.resize(m_view.sources().size(), kNone);
    m_characterNodes.resize(m_view.characters().size(), kNone);
    m_streamNodes.resize(m_view.streams().size(), kNone);
    m_rates.resize(m_view.characters().size());
    if (!insertSources() && !insertCharacters()) {
        insertStreams();
    }
    readRates();
    if (!m_roots.empty()) {
        emit dataChanged(index(0, 0), index(static_cast<int>(m_roots.size()) - 1, kColumnCount - 1));
    }
}

bool CharacterModel::insertSources() {
    const std::size_t first = m_roots.size();
    const std::size_t end = m_sourceNodes.size();
    if (first == end) {
        return false;
    }
    beginInsertRows({}, static_cast<int>(first), static_cast<int>(end) - 1);
    for (std::size_t entry = first; entry < end; ++entry) {
        addSource(entry);
    }
    endInsertRows();
    return true;
}

bool CharacterModel::insertCharacters() {
    return insertChildren(m_characterNodes, &CharacterModel::parentOfCharacter,
                          &CharacterModel::addCharacter);
}

bool CharacterModel::insertStreams() {
    return insertChildren(m_streamNodes, &CharacterModel::parentOfStream, &CharacterModel::addStream);
}

bool CharacterModel::insertChildren(const std::vector<int>& nodes,
                                    int (CharacterModel::*parentOf)(std::size_t) const,
                                    void (CharacterModel::*add)(std::size_t, int)) {
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

int CharacterModel::addNode(Kind kind, std::size_t entry, int parent) {
    const int node = static_cast<int>(m_nodes.size());
    std::vector<int>& siblings =
        parent == kNone ? m_roots : m_nodes[static_cast<std::size_t>(parent)].children;
    const int row = static_cast<int>(siblings.size());
    siblings.push_back(node);
    m_nodes.push_back({kind, entry, parent, row, {}});
    return node;
}

void CharacterModel::addSource(std::size_t entry) {
    m_sourceNodes[entry] = addNode(Kind::Source, entry, kNone);
    for (std::size_t i = 0; i < m_characterNodes.size(); ++i) {
        if (m_characterNodes[i] == kNone && m_view.characters()[i].key.source == m_view.sources()[entry].id) {
            addCharacter(i, m_sourceNodes[entry]);
        }
    }
}

void CharacterModel::addCharacter(std::size_t entry, int parent) {
    m_characterNodes[entry] = addNode(Kind::Character, entry, parent);
    for (std::size_t i = 0; i < m_streamNodes.size(); ++i) {
        if (m_streamNodes[i] == kNone &&
            characterOf(m_view.streams()[i].key) == m_view.characters()[entry].key) {
            addStream(i, m_characterNodes[entry]);
        }
    }
}

void CharacterModel::addStream(std::size_t entry, int parent) {
    m_streamNodes[entry] = addNode(Kind::Stream, entry, parent);
}

void CharacterModel::readRates() {
    for (std::size_t i = 0; i < m_rates.size(); ++i) {
        const model::CharacterKey& key = m_view.characters()[i].key;
        const model::Stream* stream = leadingStream(m_view, key);
        const auto* message = stream == nullptr ? nullptr : m_view.message(key, stream->key.type);
        if (message != nullptr && message->packet != m_rates[i].packet) {
            m_rates[i].packet = message->packet;
            m_rates[i].rate.add(message->datagram.header.sampleCounter, message->datagram.header.timeCode);
        }
    }
}

std::optional<double> CharacterModel::nominalHz(const model::Stream& stream) const {
    const model::Character* character = m_view.find(characterOf(stream.key));
    if (character == nullptr || character->ordinal >= m_rates.size() || stream.statistics.step() == 0 ||
        !wire::isSampled(stream.key.type)) {
        return std::nullopt;
    }
    const auto frameHz = m_rates[character->ordinal].rate.frameHz();
    return frameHz ? std::optional(*frameHz / stream.statistics.step()) : std::nullopt;
}

const CharacterModel::Node& CharacterModel::nodeOf(const QModelIndex& index) const {
    return m_nodes[static_cast<std::size_t>(index.internalId())];
}

QModelIndex CharacterModel::indexOfNode(int node) const {
    return node == kNone ? QModelIndex()
                         : createIndex(m_nodes[static_cast<std::size_t>(node)].row, 0,
                                       static_cast<quintptr>(static_cast<unsigned>(node)));
}

int CharacterModel::parentOfCharacter(std::size_t entry) const {
    const log::SourceId source = m_view.characters()[entry].key.source;
    const auto found = std::ranges::find(m_view.sources(), source, &model::Source::id);
    return found == m_view.sources().end()
               ? kNone
               : m_sourceNodes[static_cast<std::size_t>(found - m_view.sources().begin())];
}

int CharacterModel::parentOfStream(std::size_t entry) const {
    const model::Character* character = m_view.find(characterOf(m_view.streams()[entry].key));
    return character == nullptr ? kNone : m_characterNodes[character->ordinal];
}

std::optional<model::CharacterKey> CharacterModel::character(const QModelIndex& index) const {
    if (!index.isValid()) {
        return std::nullopt;
    }
    const Node& node = nodeOf(index);
    switch (node.kind) {
    case Kind::Character:
        return m_view.characters()[node.entry].key;
    case Kind::Stream:
        return characterOf(m_view.streams()[node.entry].key);
    case Kind::Source:
        break;
    }
    return std::nullopt;
}

std::optional<log::SourceId> CharacterModel::source(const QModelIndex& index) const {
    if (!index.isValid()) {
        return std::nullopt;
    }
    const auto key = character(index);
    return key ? key->source : m_view.sources()[nodeOf(index).entry].id;
}

QModelIndex CharacterModel::indexOf(const model::CharacterKey& key) const {
    const model::Character* found = m_view.find(key);
    return found == nullptr || found->ordinal >= m_characterNodes.size()
               ? QModelIndex()
               : indexOfNode(m_characterNodes[found->ordinal]);
}

QModelIndex CharacterModel::index(int row, int column, const QModelIndex& parent) const {
    if (!hasIndex(row, column, parent)) {
        return {};
    }
    const std::vector<int>& children = parent.isValid() ? nodeOf(parent).children : m_roots;
    return createIndex(row, column,
                       static_cast<quintptr>(static_cast<unsigned>(children[static_cast<std::size_t>(row)])));
}

QModelIndex CharacterModel::parent(const QModelIndex& index) const {
    return index.isValid() ? indexOfNode(nodeOf(index).parent) : QModelIndex();
}

int CharacterModel::rowCount(const QModelIndex& parent) const {
    if (!parent.isValid()) {
        return static_cast<int>(m_roots.size());
    }
    return parent.column() == 0 ? static_cast<int>(nodeOf(parent).children.size()) : 0;
}

int CharacterModel::columnCount(const QModelIndex&) const {
    return kColumnCount;
}

QVariant CharacterModel::data(const QModelIndex& index, int role) const {
    if (!checkIndex(index, CheckIndexOption::IndexIsValid)) {
        return {};
    }
    const Node& node = nodeOf(index);
    switch (node.kind) {
    case Kind::Source:
        return sourceData(m_view.sources()[node.entry], index.column(), role);
    case Kind::Character:
        return characterData(m_view.characters()[node.entry], index.column(), role);
    case Kind::Stream:
        break;
    }
    return streamData(m_view.streams()[node.entry], index.column(), role);
}

QVariant CharacterModel::sourceData(const model::Source& source, int column, int role) const {
    if (column == kState) {
        return stateData(sourceState(m_view, source), role);
    }
    if (column == kName) {
        return role == Qt::DisplayRole ? QString::fromStdString(source.info.address) : QVariant();
    }
    switch (role) {
    case Qt::DisplayRole:
        return transportName(source.info.transport);
    case Qt::ForegroundRole:
        return theme().dim;
    default:
        return role == Qt::TextAlignmentRole ? numberAlignment() : QVariant();
    }
}

QVariant CharacterModel::characterName(const model::Character& character, int role) const {
    switch (role) {
    case Qt::DisplayRole:
        return gui::characterName(m_view, character.key);
    case kSuffixRole:
        return QStringLiteral("· %1").arg(character.key.character);
    case kDotRole:
        return characterColour(m_view, character.key);
    case Qt::CheckStateRole:
        return m_commands.isCharacterVisible(character.key) ? Qt::Checked : Qt::Unchecked;
    case Qt::ToolTipRole:
        return tr("Character ID %1. Check mark: shown in the viewport. Double click: frame in the viewport.")
            .arg(character.key.character);
    default:
        return {};
    }
}

QVariant CharacterModel::characterData(const model::Character& character, int column, int role) const {
    if (column == kName) {
        return characterName(character, role);
    }
    if (column == kState) {
        return stateData(characterState(m_view, character), role);
    }
    if (role == Qt::TextAlignmentRole) {
        return numberAlignment();
    }
    const model::Stream* stream = leadingStream(m_view, character.key);
    return stream != nullptr && role == Qt::DisplayRole ? fixed(stream->statistics.rateHz(), 1) : QVariant();
}

QVariant CharacterModel::streamData(const model::Stream& stream, int column, int role) const {
    if (column == kState) {
        return stateData(streamState(m_view, stream), role);
    }
    if (column == kName) {
        return role == Qt::DisplayRole ? QString::fromStdString(wire::typeTitle(stream.key.type))
                                       : QVariant();
    }
    if (role == Qt::TextAlignmentRole) {
        return numberAlignment();
    }
    const auto nominal = nominalHz(stream);
    if (role == Qt::DisplayRole) {
        const QString measured = fixed(stream.statistics.rateHz(), 1);
        return nominal ? QStringLiteral("%1/%2").arg(QString::number(*nominal, 'g', 5), measured) : measured;
    }
    if (role == Qt::ToolTipRole) {
        return nominal ? tr("Nominal rate, from the sender's time code and sample counter / measured by "
                            "arrival at this computer")
                       : tr("Measured by arrival at this computer");
    }
    return {};
}

bool CharacterModel::setData(const QModelIndex& index, const QVariant& value, int role) {
    if (!checkIndex(index, CheckIndexOption::IndexIsValid) || role != Qt::CheckStateRole ||
        index.column() != kName || nodeOf(index).kind != Kind::Character) {
        return false;
    }
    m_commands.setCharacterVisible(m_view.characters()[nodeOf(index).entry].key,
                                   value.toInt() == Qt::Checked);
    emit dataChanged(index, index, {Qt::CheckStateRole});
    return true;
}

Qt::ItemFlags CharacterModel::flags(const QModelIndex& index) const {
    Qt::ItemFlags flags = QAbstractItemModel::flags(index);
    if (index.isValid() && index.column() == kName && nodeOf(index).kind == Kind::Character) {
        flags |= Qt::ItemIsUserCheckable;
    }
    return flags;
}

QVariant CharacterModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal) {
        return {};
    }
    if (role == Qt::TextAlignmentRole && section != kName) {
        return numberAlignment();
    }
    if (role == Qt::ToolTipRole && section == kState) {
        return tr("How often the sample counter moved by something else than its step; or what is wrong");
    }
    if (role != Qt::DisplayRole) {
        return {};
    }
    switch (section) {
    case kName:
        return tr("Character, stream");
    case kRate:
        return tr("Hz");
    default:
        return tr("Gaps");
    }
}

} // namespace posewire::gui
