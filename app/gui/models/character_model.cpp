// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/character_model.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/model/body/character_pose.h"
#include "core/model/session/accounts.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>

namespace posewire::gui {

namespace {

/// Of a recording, how much of it is read for the sender's clock.
constexpr log::Duration kReadBack = std::chrono::seconds(3);
constexpr std::size_t kMostRead = 2'000;

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

/// Now on the wire; of a recording at the cursor.
double characterAge(const model::SessionView& view, log::Stamp newest) {
    const log::Stamp now = view.isRecording() ? view.cursorStamp() : view.now();
    return std::max(0.0, log::secondsOf(now - newest));
}

/// The rate of a whole recording; on the wire that of now.
double measuredHz(const model::SessionView& view, const model::Stream& stream) {
    return view.isRecording() ? model::figuresOf(stream)[model::Figure::RateWhole]
                              : stream.rateAt(view.now());
}

QString hertz(const std::optional<double>& rateHz, bool isNominal) {
    if (!rateHz) {
        return dash();
    }
    return isNominal ? QString::number(*rateHz, 'g', 5) : fixed(*rateHz, 1);
}

/// Seconds, without the unit, which is in the title.
QString ageText(double seconds) {
    return seconds < 1000 ? fixed(seconds, 1) : grouped(static_cast<std::uint64_t>(seconds));
}

template <class Row>
TableColumn<Row> lostColumn(const QString& title, model::LossCause cause, int order, const QString& help) {
    const auto at = static_cast<std::size_t>(cause);
    return TableColumn<Row>::numbers(title, help, [at](const Row& row) { return grouped(row.lost[at]); })
        .in({.usual = QStringLiteral("9 999"), .order = order})
        .withColour([at](const Row& row) { return row.lost[at] == 0 ? QVariant(theme().dim) : QVariant(); });
}

/// Rates, losses and age: the same for characters and their streams, side by side and of the same time.
template <class Row>
void addFigureColumns(std::vector<TableColumn<Row>>& columns) {
    using Column = TableColumn<Row>;
    columns.push_back(
        Column::numbers(tr("Nom."),
                        tr("Nominal rate in Hz, by the sender's own time code and sample counter"),
                        [](const Row& row) { return hertz(row.nominalHz, true); })
            .in({.usual = QStringLiteral("240"), .order = 2})
            .dimmed());
    columns.push_back(
        Column::numbers(tr("Hz"), tr("Rate in Hz, measured by arrival at this computer"), [](const Row& row) {
            return hertz(row.measuredHz, false);
        }).in({.usual = QStringLiteral("240.0"), .order = 4}));
    columns.push_back(lostColumn<Row>(tr("Here"), model::LossCause::ThisComputer, 6,
                                      tr("Samples of all its streams that this computer lost, in the time "
                                         "that stands above the table")));
    columns.push_back(lostColumn<Row>(tr("Network"), model::LossCause::Network, 8,
                                      tr("Samples that the network lost, in the time that stands above the "
                                         "table")));
    columns.push_back(lostColumn<Row>(tr("Sender"), model::LossCause::Sender, 7,
                                      tr("Samples that the sender left out, in the time that stands above "
                                         "the table")));
    columns.push_back(lostColumn<Row>(tr("Unknown"), model::LossCause::Unknown, 5,
                                      tr("Samples lost, cause unknown, in the time that "
                                         "stands above the table")));
    columns.push_back(Column::numbers(tr("Age"), tr("Seconds since its newest datagram"),
                                      [](const Row& row) { return ageText(row.ageS); })
                          .in({.usual = QStringLiteral("99.9"), .order = 3})
                          .withColour([](const Row& row) {
                              const double patience = patienceAt(row.nominalHz.value_or(0));
                              return !row.nominalHz                               ? QVariant()
                                     : row.ageS >= std::max(kStaleAge, patience)  ? QVariant(theme().error)
                                     : row.ageS >= std::max(kSilentAge, patience) ? QVariant(theme().warning)
                                                                                  : QVariant();
                          }));
}

std::vector<TableColumn<DetailRow>> detailColumns() {
    using Column = TableColumn<DetailRow>;
    std::vector<Column> columns{Column::words(tr("Stream"), {}, [](const DetailRow& row) {
                                    return typeTitle(row.key.type);
                                }).in({.usual = typeTitle(2), .isOpen = true})};
    addFigureColumns(columns);
    return columns;
}

std::vector<TableColumn<EndedSender>> endedColumns() {
    using Column = TableColumn<EndedSender>;
    return {Column::words(tr("Ended sender"), {}, [](const EndedSender& row) { return row.address; })
                .in({QStringLiteral("255.255.255.255:65535")}),
            Column::words(tr("Characters"), {}, [](const EndedSender& row) { return row.characters; })
                .in({.usual = QStringLiteral("12345678"), .isOpen = true}),
            Column::numbers(tr("Ended at"), {}, [](const EndedSender& row) {
                return row.ended;
            }).in({QStringLiteral("00:00:00")})};
}

/// "· 2"; with its sender where another one has the same name and ID.
QString idWords(const model::SessionView& view, const model::CharacterKey& key) {
    const QString sender = senderApart(view, key);
    const QString id = QStringLiteral("· %1").arg(key.character);
    return sender.isEmpty() ? id : id + QStringLiteral(" · ") + sender;
}

QString clockOf(const model::SessionView& view, log::Stamp stamp) {
    return timeOfDay(view.wallOf(stamp)).chopped(4);
}

} // namespace

std::optional<model::TimeRange> boardSpan(const model::SessionView& view) {
    if (view.isRecording()) {
        return std::nullopt;
    }
    // What arrives at this very moment belongs to it.
    return model::TimeRange{model::recentSpan(view).from, view.now() + log::Duration(1)};
}

QString boardSpanText(const model::SessionView& view) {
    if (view.isRecording()) {
        return tr("whole recording");
    }
    const log::Duration recent = model::VerdictSpan::kRecent;
    const bool isAll = view.choices().reset != log::Stamp() && view.now() - view.choices().reset < recent;
    return isAll ? tr("now, since the reset") : tr("now, last %1 s").arg(recent / std::chrono::seconds(1));
}

std::vector<model::CharacterKey> boardOf(const model::SessionView& view, BoardOrder order) {
    std::vector<model::CharacterKey> keys;
    std::ranges::transform(view.atNow().roster().listed(), std::back_inserter(keys), &model::Character::key);
    if (order == BoardOrder::TroubleFirst) {
        using State = model::TakeVerdict::State;
        std::ranges::stable_sort(keys, {}, [&view](const model::CharacterKey& key) {
            constexpr std::array kRanks{2, 3, 1, 0}; // by State
            static_assert(static_cast<int>(State::Bad) == 3);
            return kRanks[static_cast<std::size_t>(view.verdicts().of(key).state)];
        });
    }
    return keys;
}

void NominalRates::follow(const model::SessionView& view,
                          const std::vector<model::CharacterKey>& characters) {
    const std::set<model::CharacterKey> there(characters.begin(), characters.end());
    std::erase_if(m_rates, [&](const auto& entry) { return !there.contains(entry.first); });
    for (const model::CharacterKey& key : characters) {
        const model::Character& character = *view.roster().find(key);
        const model::Stream* stream = leadingStream(character);
        if (stream == nullptr) {
            continue;
        }
        Learnt& learnt = m_rates[key];
        const std::uint64_t restarts = character.counterRestarts();
        if (learnt.type != stream->key.type || learnt.restarts != restarts) {
            learnt = {stream->key.type, restarts, 0, {}};
        }
        if (view.isRecording()) {
            if (!learnt.rate.frameHz() && std::exchange(learnt.end, view.end()) != view.end()) {
                view.messages().visitHeaders(stream->key, stream->accounting.lastStamp() - kReadBack,
                                             kMostRead,
                                             [&learnt](log::Stamp /*stamp*/, const wire::Header& header) {
                                                 learnt.rate.add(header.sampleCounter, header.timeCode);
                                             });
            }
        } else if (stream->newest.packet != UINT64_MAX) {
            const wire::Header& header = stream->newest.datagram.header;
            learnt.rate.add(header.sampleCounter, header.timeCode);
        }
    }
}

std::optional<double> NominalRates::of(const model::Stream& stream) const {
    const auto learnt = m_rates.find({stream.key.sender, stream.key.character});
    if (learnt == m_rates.end() || stream.accounting.step() == 0 || !wire::isSampled(stream.key.type)) {
        return std::nullopt;
    }
    const auto frameHz = learnt->second.rate.frameHz();
    return frameHz ? std::optional(*frameHz / stream.accounting.step()) : std::nullopt;
}

CharacterModel::CharacterModel(model::SessionView& view, Commands& commands)
    : TableModel(columns(view)), m_view(view), m_commands(commands) {}

void CharacterModel::refresh() {
    const auto keys = boardOf(m_view, m_order);
    m_rates.follow(m_view, keys);
    const model::Losses losses(m_view, boardSpan(m_view));
    std::vector<BoardRow> rows;
    for (const model::CharacterKey& key : keys) {
        BoardRow row;
        row.key = key;
        row.verdict = m_view.verdicts().of(key);
        row.restarts = m_view.accounts().restartsOf(key);
        row.ageS = characterAge(m_view, m_view.roster().find(key)->lastStamp);
        if (const model::Stream* leading = leadingStream(*m_view.roster().find(key))) {
            row.nominalHz = m_rates.of(*leading);
            row.measuredHz = measuredHz(m_view, *leading);
        }
        for (const model::Character* one : m_view.roster().lineage(key)) {
            for (const model::Stream* stream : one->streams) {
                losses.addTo(row.lost, *stream);
            }
        }
        if (const model::CharacterPose* pose = m_view.messages().pose(key)) {
            row.poseType = pose->type;
        }
        rows.push_back(std::move(row));
    }
    setRows(std::move(rows));
}

std::vector<TableColumn<BoardRow>> CharacterModel::columns(model::SessionView& view) {
    using Column = TableColumn<BoardRow>;
    const auto help = [&view](const BoardRow& row) {
        return tr("Character ID %1, %2. Check mark: shown in the viewport. Double click: frame in the "
                  "viewport.")
            .arg(row.key.character)
            .arg(portHistory(view, row.key));
    };
    const auto marks = [&view](const BoardRow& row, int role) {
        switch (role) {
        case Qt::CheckStateRole:
            return QVariant(view.roster().isHidden(row.key) ? Qt::Unchecked : Qt::Checked);
        case kSuffixRole:
            return QVariant(idWords(view, row.key));
        case kDotRole:
            return QVariant::fromValue(characterMark(view, row.key));
        default:
            return QVariant();
        }
    };
    Column name = Column::words(tr("Character"), {},
                                [&view](const BoardRow& row) { return characterName(view.atNow(), row.key); })
                      .in({.usual = QStringLiteral("         Mira Li"),
                           .wish = QStringLiteral("         Performer with a name · 10"),
                           .least = QStringLiteral("         Mira L"),
                           .whole = 16})
                      .withToolTip(help)
                      .withMore(marks);
    name.spoken = [&view](const BoardRow& row) { return nameApart(view.atNow(), row.key); };
    std::vector<Column> columns{
        std::move(name),
        valueColumn(Column::words(tr("Verdict"), tr("Whether it is good now on the wire"), {}),
                    [](const BoardRow& row) { return verdictState(row.verdict); })
            .in({.usual = tr("■ 10.0 % lost"), .isOpen = true, .whole = 26})
            .withMore([](const BoardRow& row, int role) {
                if (role == kShortTextRole) { // whose loss it is stands beside it, in the columns of losses
                    return QVariant(
                        PropertyValue{said(row.verdict.said, words::Form::Cell), healthOf(row.verdict.state)}
                            .display());
                }
                return role == kSuffixRole && row.restarts != 0
                           ? QVariant(QStringLiteral("↻ ") + restartWords(row.restarts))
                           : QVariant();
            })};
    addFigureColumns(columns);
    columns.push_back(Column::words(tr("Pose"), tr("The type of message that its figure is drawn from"),
                                    [](const BoardRow& row) {
                                        return row.poseType
                                                   ? QString::fromStdString(wire::typeDigits(*row.poseType))
                                                   : tr("none");
                                    })
                          .in({.usual = tr("none"), .order = 1}));
    return columns;
}

std::optional<model::CharacterKey> CharacterModel::character(const QModelIndex& index) const {
    return index.isValid() ? std::optional(rows()[static_cast<std::size_t>(index.row())].key) : std::nullopt;
}

QModelIndex CharacterModel::indexOf(const model::CharacterKey& key) const {
    const auto row = std::ranges::find_if(
        rows(), [&](const BoardRow& one) { return m_view.roster().isSame(one.key, key); });
    return row == rows().end() ? QModelIndex() : index(static_cast<int>(row - rows().begin()), 0);
}

bool CharacterModel::setData(const QModelIndex& index, const QVariant& value, int role) {
    if (!checkIndex(index, CheckIndexOption::IndexIsValid) || role != Qt::CheckStateRole ||
        index.column() != kName) {
        return false;
    }
    m_commands.setCharacterVisible(*character(index), value.toInt() == Qt::Checked);
    emit dataChanged(index, index, {Qt::CheckStateRole});
    return true;
}

Qt::ItemFlags CharacterModel::flags(const QModelIndex& index) const {
    Qt::ItemFlags flags = TableModel::flags(index);
    if (index.isValid() && index.column() == kName) {
        flags |= Qt::ItemIsUserCheckable;
    }
    return flags;
}

CharacterDetailModel::CharacterDetailModel(model::SessionView& view)
    : TableModel(detailColumns()), m_view(view) {}

void CharacterDetailModel::refresh(const std::optional<model::CharacterKey>& key, const NominalRates& rates) {
    std::vector<DetailRow> rows;
    const model::Character* character = key ? m_view.roster().find(*key) : nullptr;
    if (character != nullptr) {
        const model::Losses losses(m_view, boardSpan(m_view));
        for (const model::Stream* stream : character->streams) {
            DetailRow row;
            row.key = stream->key;
            row.ageS = characterAge(m_view, stream->accounting.lastStamp());
            row.nominalHz = rates.of(*stream);
            if (wire::isSampled(stream->key.type)) {
                row.measuredHz = measuredHz(m_view, *stream);
            }
            row.lost = losses.of(*stream).byCause;
            rows.push_back(row);
        }
        std::ranges::sort(rows, {}, [](const DetailRow& row) { return row.key.type; });
    }
    setRows(std::move(rows));
}

EndedSenderModel::EndedSenderModel(model::SessionView& view) : TableModel(endedColumns()), m_view(view) {}

void EndedSenderModel::refresh() {
    std::vector<EndedSender> rows;
    for (const model::Sender* sender : m_view.accounts().endedSenders()) {
        QStringList names;
        for (const model::Character* character : sender->characters) {
            names += characterName(m_view, character->key);
        }
        rows.push_back({sender->id, shown(sender->address()), names.join(QStringLiteral(", ")),
                        clockOf(m_view, sender->lastStamp)});
    }
    setRows(std::move(rows));
}

QString portHistory(const model::SessionView& view, const model::CharacterKey& key) {
    QStringList parts;
    for (const model::Character* one : view.roster().lineage(key)) {
        const QString address = shown(view.roster().addressOf(one->key.sender));
        parts += one->key == key ? (parts.isEmpty() ? tr("from %1") : tr("now from %1")).arg(address)
                                 : tr("from %1 until %2").arg(address, clockOf(view, one->lastStamp));
    }
    return parts.join(QStringLiteral(", "));
}

QString restartWords(std::uint64_t restarts) {
    return restarts == 0 ? QString() : tr("restarted %1 ×").arg(grouped(restarts));
}

} // namespace posewire::gui
