// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/character_model.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/stream_state.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/session/ingest.h"
#include "core/wire/type_table.h"

#include <array>

namespace posewire::gui {

namespace {

QString transportName(log::Transport transport) {
    const std::array names{QStringLiteral("UDP"), QStringLiteral("TCP"), tr("file"),
                           tr("demo")}; // by Transport
    return names[static_cast<std::size_t>(transport)];
}

/// Shows how fast a character comes: its pose, or else the fastest of its streams.
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

} // namespace

CharacterModel::CharacterModel(model::SessionView& view, Commands& commands, QObject* parent)
    : StreamTreeModel(view, columns(*this), parent), m_commands(commands) {}

void CharacterModel::refresh() {
    insertNew();
    m_rates.resize(view().characters().size());
    for (std::size_t i = 0; i < m_rates.size(); ++i) {
        const model::CharacterKey& key = view().characters()[i].key;
        const model::Stream* stream = leadingStream(view(), key);
        const auto* message = stream == nullptr ? nullptr : view().message(key, stream->key.type);
        if (message != nullptr) {
            m_rates[i].add(message->datagram.header.sampleCounter, message->datagram.header.timeCode);
        }
    }
    announceChange();
}

std::optional<double> CharacterModel::nominalHz(const model::Stream& stream) const {
    const model::Character* character = view().find(characterOf(stream.key));
    if (character == nullptr || character->ordinal >= m_rates.size() || stream.accounting.step() == 0 ||
        !wire::isSampled(stream.key.type)) {
        return std::nullopt;
    }
    const auto frameHz = m_rates[character->ordinal].frameHz();
    return frameHz ? std::optional(*frameHz / stream.accounting.step()) : std::nullopt;
}

std::vector<TableColumn<StreamRow>> CharacterModel::columns(const CharacterModel& model) {
    using Column = TableColumn<StreamRow>;
    const auto help = [&model](const StreamRow& row) {
        return row.kind == Kind::Character ? tr("Character ID %1. Check mark: shown in the viewport. Double "
                                                "click: frame in the viewport.")
                                                 .arg(model.view().characters()[row.entry].key.character)
                                           : QString();
    };
    const auto name = [&model](const StreamRow& row) { return model.nameOf(row); };
    const auto marks = [&model](const StreamRow& row, int role) {
        if (role == Qt::CheckStateRole && row.kind == Kind::Character) {
            const bool isHidden = model.view().isHidden(model.view().characters()[row.entry].key);
            return QVariant(isHidden ? Qt::Unchecked : Qt::Checked);
        }
        return model.marksOf(row, role);
    };
    return {
        Column::words(tr("Character, stream"), {}, name).withToolTip(help).withMore(marks),
        Column::numbers(tr("Hz"), {}, [&model](const auto& row) { return model.rateOf(row); })
            .withColour([](const StreamRow& row) {
                return row.kind == Kind::Sender ? QVariant(theme().dim) : QVariant();
            })
            .withToolTip([&model](const auto& row) { return model.rateHelp(row); }),
        valueColumn(Column::numbers(tr("Lost"), tr("Samples that never arrived, or what is wrong"), {}),
                    [&model](const StreamRow& row) { return model.stateOf(row); }),
    };
}

QString CharacterModel::rateOf(const StreamRow& row) const {
    if (row.kind == Kind::Sender) {
        return transportName(view().senders()[row.entry].info.transport);
    }
    if (row.kind == Kind::Character) {
        const model::Stream* leading = leadingStream(view(), view().characters()[row.entry].key);
        return leading == nullptr ? QString() : fixed(leading->statistics.rateHz(), 1);
    }
    const model::Stream& stream = view().streams()[row.entry];
    const auto nominal = nominalHz(stream);
    const QString measured = fixed(stream.statistics.rateHz(), 1);
    return nominal ? QStringLiteral("%1/%2").arg(QString::number(*nominal, 'g', 5), measured) : measured;
}

QString CharacterModel::rateHelp(const StreamRow& row) const {
    if (row.kind != Kind::Stream) {
        return {};
    }
    return nominalHz(view().streams()[row.entry]) ? tr("Nominal rate, from the sender's time code and sample "
                                                       "counter / measured by arrival at this "
                                                       "computer")
                                                  : tr("Measured by arrival at this computer");
}

/// The tooltip says it in full, since a narrow column cuts it; of senders with every contradiction in what
/// they send.
PropertyValue CharacterModel::stateOf(const StreamRow& row) const {
    PropertyValue state;
    QStringList lines;
    switch (row.kind) {
    case Kind::Sender:
        state = senderState(view(), view().senders()[row.entry]);
        for (const model::Contradiction& one : view().senders()[row.entry].contradictions()) {
            lines += healthText(Health::Warning, QString::fromStdString(one.text));
        }
        break;
    case Kind::Character:
        state = characterState(view(), view().characters()[row.entry]);
        break;
    case Kind::Stream:
        state = streamState(view(), view().streams()[row.entry]);
        break;
    }
    lines.prepend(state.display());
    lines.removeAll(QString());
    state.toolTip = lines.join(QLatin1Char('\n'));
    return state;
}

bool CharacterModel::setData(const QModelIndex& index, const QVariant& value, int role) {
    if (!checkIndex(index, CheckIndexOption::IndexIsValid) || role != Qt::CheckStateRole ||
        index.column() != kName || rowOf(index).kind != Kind::Character) {
        return false;
    }
    m_commands.setCharacterVisible(view().characters()[rowOf(index).entry].key, value.toInt() == Qt::Checked);
    emit dataChanged(index, index, {Qt::CheckStateRole});
    return true;
}

Qt::ItemFlags CharacterModel::flags(const QModelIndex& index) const {
    Qt::ItemFlags flags = QAbstractItemModel::flags(index);
    if (index.isValid() && index.column() == kName && rowOf(index).kind == Kind::Character) {
        flags |= Qt::ItemIsUserCheckable;
    }
    return flags;
}

} // namespace posewire::gui
