// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/character_model.h"

#include "app/gui/models/columns.h"
#include "app/gui/models/roles.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/stream_state.h"
#include "app/gui/models/text.h"
#include "core/model/session/message.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <array>

namespace posewire::gui {

namespace {

model::CharacterKey characterOf(const log::StreamKey& key) {
    return {key.sender, key.character};
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
        if (const auto* stream = view.find(log::StreamKey{key.sender, key.character, type})) {
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
    case Qt::ToolTipRole:
        return state.display(); // a narrow column cuts it
    default:
        return role == Qt::TextAlignmentRole ? numberAlignment() : QVariant();
    }
}

} // namespace

CharacterModel::CharacterModel(model::SessionView& view, Commands& commands, QObject* parent)
    : StreamTreeModel(view, parent), m_view(view), m_commands(commands) {}

void CharacterModel::refresh() {
    insertNew();
    m_rates.resize(m_view.characters().size());
    readRates();
    announceChange();
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
    if (character == nullptr || character->ordinal >= m_rates.size() || stream.accounting.step() == 0 ||
        !wire::isSampled(stream.key.type)) {
        return std::nullopt;
    }
    const auto frameHz = m_rates[character->ordinal].rate.frameHz();
    return frameHz ? std::optional(*frameHz / stream.accounting.step()) : std::nullopt;
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
    case Kind::Sender:
        return senderData(m_view.senders()[node.entry], index.column(), role);
    case Kind::Character:
        return characterData(m_view.characters()[node.entry], index.column(), role);
    case Kind::Stream:
        break;
    }
    return streamData(m_view.streams()[node.entry], index.column(), role);
}

/// The state in full, and each contradiction in what the sender sends.
QString CharacterModel::senderWords(const model::Sender& sender) const {
    QStringList lines{senderState(m_view, sender).display()};
    for (const model::Contradiction& one : sender.contradictions()) {
        lines += healthSymbol(Health::Warning) + QLatin1Char(' ') + QString::fromStdString(one.text);
    }
    lines.removeAll(QString());
    return lines.join(QLatin1Char('\n'));
}

QVariant CharacterModel::senderData(const model::Sender& sender, int column, int role) const {
    if (column == kState) {
        return role == Qt::ToolTipRole ? senderWords(sender) : stateData(senderState(m_view, sender), role);
    }
    if (column == kName) {
        return role == Qt::DisplayRole ? QString::fromStdString(sender.info.address) : QVariant();
    }
    switch (role) {
    case Qt::DisplayRole:
        return transportName(sender.info.transport);
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
        return m_view.isHidden(character.key) ? Qt::Unchecked : Qt::Checked;
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
        return tr("Samples that did not come; or what is wrong");
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
        return tr("Lost");
    }
}

} // namespace posewire::gui
