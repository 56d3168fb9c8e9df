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
const model::Stream* leadingStream(const model::Character& character) {
    for (const std::uint8_t type : std::array<std::uint8_t, 3>{2, 1, 5}) {
        const auto pose =
            std::ranges::find(character.streams, type, [](const auto* stream) { return stream->key.type; });
        if (pose != character.streams.end()) {
            return *pose;
        }
    }
    const model::Stream* fastest = nullptr;
    for (const model::Stream* stream : character.streams) {
        if (wire::isSampled(stream->key.type) &&
            (fastest == nullptr || stream->statistics.rateHz() > fastest->statistics.rateHz())) {
            fastest = stream;
        }
    }
    return fastest;
}

} // namespace

CharacterModel::CharacterModel(model::SessionView& view, Commands& commands, QObject* parent)
    : StreamTreeModel(view, columns(*this), parent), m_commands(commands) {}

void CharacterModel::refresh() {
    if (insertNew()) {
        std::erase_if(m_rates, [this](const auto& entry) { return view().find(entry.first) == nullptr; });
    }
    for (const model::Character& character : view().characters()) {
        const model::Stream* stream = leadingStream(character);
        const auto* message = stream == nullptr ? nullptr : view().message(character.key, stream->key.type);
        if (message != nullptr) {
            m_rates[character.key].add(message->datagram.header.sampleCounter,
                                       message->datagram.header.timeCode);
        }
    }
    announceChange();
}

std::optional<double> CharacterModel::nominalHz(const model::Stream& stream) const {
    const auto rate = m_rates.find(characterOf(stream.key));
    if (rate == m_rates.end() || stream.accounting.step() == 0 || !wire::isSampled(stream.key.type)) {
        return std::nullopt;
    }
    const auto frameHz = rate->second.frameHz();
    return frameHz ? std::optional(*frameHz / stream.accounting.step()) : std::nullopt;
}

std::vector<TableColumn<StreamRow>> CharacterModel::columns(const CharacterModel& model) {
    using Column = TableColumn<StreamRow>;
    const auto help = [&model](const StreamRow& row) {
        return row.kind == Kind::Character ? tr("Character ID %1. Check mark: shown in the viewport. Double "
                                                "click: frame in the viewport.")
                                                 .arg(row.key.character)
                                           : QString();
    };
    const auto name = [&model](const StreamRow& row) { return model.nameOf(row); };
    const auto marks = [&model](const StreamRow& row, int role) {
        if (role == Qt::CheckStateRole && row.kind == Kind::Character) {
            const bool isHidden = model.view().isHidden(characterOf(row.key));
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
        return transportName(senderOf(row).info.transport);
    }
    if (row.kind == Kind::Character) {
        const model::Stream* leading = leadingStream(characterAt(row));
        return leading == nullptr ? QString() : fixed(leading->statistics.rateHz(), 1);
    }
    const model::Stream& stream = streamOf(row);
    const auto nominal = nominalHz(stream);
    const QString measured = fixed(stream.statistics.rateHz(), 1);
    return nominal ? QStringLiteral("%1/%2").arg(QString::number(*nominal, 'g', 5), measured) : measured;
}

QString CharacterModel::rateHelp(const StreamRow& row) const {
    if (row.kind != Kind::Stream) {
        return {};
    }
    return nominalHz(streamOf(row)) ? tr("Nominal rate, from the sender's time code and sample "
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
        state = senderState(view(), senderOf(row));
        for (const model::Contradiction& one : senderOf(row).contradictions()) {
            lines += healthText(Health::Warning, QString::fromStdString(one.text));
        }
        break;
    case Kind::Character:
        state = characterState(view(), characterAt(row));
        break;
    case Kind::Stream:
        state = streamState(view(), streamOf(row));
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
    m_commands.setCharacterVisible(characterOf(rowOf(index).key), value.toInt() == Qt::Checked);
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
