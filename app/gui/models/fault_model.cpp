// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/fault_model.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/export/sheets.h"
#include "core/model/session/roster.h"
#include "core/wire/type_table.h"

#include <algorithm>

namespace posewire::gui {

namespace {

using FaultColumn = TableColumn<FaultRow>;

/// The cause of a column; nothing where it has all.
std::optional<model::LossCause> causeIn(int column) {
    const bool isCause = column >= FaultModel::kThisComputer && column <= FaultModel::kUnknown;
    return isCause ? std::optional(static_cast<model::LossCause>(column - FaultModel::kThisComputer))
                   : std::nullopt;
}

std::uint64_t lostIn(const FaultRow& row, int column) {
    const auto cause = causeIn(column);
    return cause ? row.counts.lost[static_cast<std::size_t>(*cause)] : row.counts.total();
}

/// "0.4 %", "12 %": never 0 where there is something.
QString shareText(double share) {
    const double percent = 100 * share;
    return percent < 0.05   ? tr("<0.1 %")
           : percent < 9.95 ? tr("%1 %").arg(fixed(percent, 1))
                            : tr("%1 %").arg(fixed(percent, 0));
}

QString countText(const FaultRow& row, int column) {
    const std::uint64_t lost = lostIn(row, column);
    const QString text = row.counts.expected == 0 && lost == 0 ? dash() : grouped(lost);
    return column == FaultModel::kLost && lost != 0 ? healthText(Health::Warning, text) : text;
}

/// Only the sum has a colour, and what this computer itself lost.
QVariant countColour(const FaultRow& row, int column) {
    const bool isHere = causeIn(column) == model::LossCause::ThisComputer;
    return lostIn(row, column) == 0      ? QVariant(theme().dim)
           : isHere                      ? QVariant(theme().error)
           : column == FaultModel::kLost ? QVariant(theme().warning)
                                         : QVariant();
}

FaultColumn countColumn(int column, const QString& title, const QString& help) {
    // Shares give way to names.
    const QString mark = column == FaultModel::kLost ? QStringLiteral("▲ ") : QString();
    FaultColumn made =
        FaultColumn::numbers(title, help, [column](const FaultRow& row) {
            return countText(row, column);
        }).in({.usual = mark + QStringLiteral("9 999"), .wish = mark + QStringLiteral("9 999 <0.1 %")});
    made.colour = [column](const FaultRow& row) { return countColour(row, column); };
    made.more = [column](const FaultRow& row, int role) {
        const std::uint64_t lost = lostIn(row, column);
        const bool hasShare = lost != 0 && row.counts.expected != 0;
        return role != kSuffixRole ? QVariant()
               : hasShare          ? QVariant(shareText(row.counts.shareOf(lost)))
                                   : QVariant(QString());
    };
    made.spoken = [column](const FaultRow& row) {
        const std::uint64_t lost = lostIn(row, column);
        return lost == 0 ? tr("none") : tr("%1, %2").arg(grouped(lost), shareText(row.counts.shareOf(lost)));
    };
    return made;
}

} // namespace

std::vector<TableColumn<FaultRow>> FaultModel::columns(const FaultModel& model) {
    FaultColumn name = FaultColumn::words(
        tr("Character"),
        tr("Each character is one row through restarts of its sender; its streams are below it"),
        [&model](const FaultRow& row) { return model.nameOf(row); });
    name.room = {.usual = tr("    ● All characters"), .isOpen = true, .whole = 16};
    name.more = [&model](const FaultRow& row, int role) { return model.marksOf(row, role); };
    name.spoken = [&model](const FaultRow& row) {
        return row.kind == FaultRow::Character ? nameApart(namesBeside(model.m_view), row.current)
                                               : model.nameOf(row);
    };
    FaultColumn expected = FaultColumn::numbers(
        tr("Expected"), tr("Samples that should have come; shares are of these"),
        [](const FaultRow& row) { return row.counts.expected == 0 ? dash() : grouped(row.counts.expected); });
    return withHelpInCells(std::vector<FaultColumn>{
        std::move(name), countColumn(kThisComputer, tr("Here"), tr("Samples that this computer dropped")),
        countColumn(kNetwork, tr("Network"), tr("Samples that the network lost")),
        countColumn(kSender, tr("Sender"), tr("Samples that the sender never sent")),
        countColumn(kUnknown, tr("Unknown"), tr("Samples lost without evidence of the cause")),
        countColumn(kLost, tr("Lost"), tr("Samples of which nothing or not all came, whatever the cause")),
        std::move(expected)
            .in({.usual = QStringLiteral("99 999 999"), .order = ColumnRoom::kOnChoice})
            .dimmed()});
}

QString FaultModel::nameOf(const FaultRow& row) const {
    switch (row.kind) {
    case FaultRow::All:
        return tr("All characters");
    case FaultRow::Character:
        return characterName(namesBeside(m_view), row.current);
    case FaultRow::Unconfirmed:
        return tr("Unconfirmed");
    case FaultRow::Stream:
        break;
    }
    return typeTitle(row.type);
}

QVariant FaultModel::marksOf(const FaultRow& row, int role) const {
    if (row.kind == FaultRow::Unconfirmed && role == kSuffixRole) {
        return tr("too few datagrams that agree to be a character");
    }
    if (row.kind != FaultRow::Character) {
        return {};
    }
    if (role == kDotRole) {
        return QVariant::fromValue(characterMark(namesBeside(m_view), row.current));
    }
    const bool isTwice = std::ranges::any_of(m_rows, [&](const FaultRow& other) {
        return other.kind == FaultRow::Character && other.first != row.first &&
               other.first.character == row.first.character;
    });
    const QString id = QStringLiteral("· %1").arg(row.current.character);
    if (!isTwice || role != kSuffixRole) {
        return role == kSuffixRole ? QVariant(id) : QVariant();
    }
    const QString apart = senderApart(m_view, row.current);
    const QString sender = apart.isEmpty() ? shown(m_view.roster().addressOf(row.current.sender)) : apart;
    return tr("%1 · %2").arg(id, sender);
}

void FaultModel::refresh() {
    m_range = m_view.range();
    const model::FaultMatrix matrix = model::faultMatrix(m_view, m_range);
    std::vector<FaultRow> rows;
    const auto add = [&rows](const model::CharacterFaults& character, FaultRow::Kind kind) {
        const std::size_t own = rows.size();
        rows.push_back({kind, character.first, character.current, 0, character.counts});
        for (const model::StreamFaults& stream : character.streams) {
            rows[own].streams.insert(rows[own].streams.end(), stream.streams.begin(), stream.streams.end());
            if (kind == FaultRow::Character) {
                rows.push_back({FaultRow::Stream, character.first, character.current, stream.type,
                                stream.counts, stream.streams});
            }
        }
    };
    std::ranges::for_each(matrix.characters, [&](const auto& one) { add(one, FaultRow::Character); });
    if (matrix.unconfirmed) {
        add(*matrix.unconfirmed, FaultRow::Unconfirmed);
    }
    if (!rows.empty()) {
        FaultRow all{.counts = matrix.sum};
        for (const FaultRow& row : rows) {
            if (row.kind != FaultRow::Stream) {
                all.streams.insert(all.streams.end(), row.streams.begin(), row.streams.end());
            }
        }
        rows.insert(rows.begin(), std::move(all));
    }
    if (std::ranges::equal(rows, m_rows, &FaultRow::isSame)) {
        m_rows = std::move(rows);
        chooseCauses();
        announceChange();
        return;
    }
    beginResetModel();
    m_rows = std::move(rows);
    clearPlaces();
    int above = -1;
    for (int row = 0; row < static_cast<int>(m_rows.size()); ++row) {
        const bool isTop = m_rows[static_cast<std::size_t>(row)].kind != FaultRow::Stream;
        place(row, isTop ? -1 : above);
        above = isTop ? row : above;
    }
    endResetModel();
    chooseCauses();
}

void FaultModel::chooseCauses() {
    constexpr std::size_t kMostLeaving = 2;
    std::vector<int> leaving;
    for (const int column : {kThisComputer, kUnknown, kSender}) {
        if (!m_rows.empty() && lostIn(m_rows.front(), column) == 0 && leaving.size() < kMostLeaving) {
            leaving.push_back(column);
        }
    }
    if (std::exchange(m_leaving, leaving) != leaving) {
        emit headerDataChanged(Qt::Horizontal, kThisComputer, kUnknown);
    }
}

ColumnRoom FaultModel::room(int column) const {
    ColumnRoom given = ColumnModel::room(column);
    const auto place = std::ranges::find(m_leaving, column);
    if (column == kLost) {
        given.order = 1;
    } else if (place != m_leaving.end()) {
        given.order = 2 + static_cast<int>(place - m_leaving.begin());
    }
    return given;
}

QModelIndex FaultModel::indexOf(const FaultRow& like, int column) const {
    const auto found = std::ranges::find_if(m_rows, [&](const FaultRow& row) { return row.isSame(like); });
    return found == m_rows.end() ? QModelIndex()
                                 : TreeModel::indexOf(static_cast<int>(found - m_rows.begin()), column);
}

std::uint64_t FaultModel::lost(const QModelIndex& index) const {
    return lostIn(row(index), index.column());
}

PacketsBehind FaultModel::packetsBehind(const QModelIndex& index) const {
    const FaultRow& of = row(index);
    const bool isLoss = index.column() >= kThisComputer && index.column() <= kLost;
    return isLoss ? lossesBehind(m_view, {of.streams, causeIn(index.column()), m_range})
                  : streamsBehind(m_view, of.streams, m_range);
}

QString FaultModel::csv() const {
    const auto line = [](std::initializer_list<QString> words, const auto& numbers) {
        std::vector<std::string> cells;
        std::ranges::transform(words, std::back_inserter(cells), &QString::toStdString);
        std::ranges::copy(numbers, std::back_inserter(cells));
        return exporting::csvLine(cells);
    };
    std::vector<std::string> titles;
    titles.push_back(tr("This computer").toStdString());
    for (int column = kNetwork; column <= kExpected; ++column) {
        titles.push_back(headerData(column, Qt::Horizontal, Qt::DisplayRole).toString().toStdString());
    }
    std::string text = line({tr("Character"), tr("Name"), tr("Type")}, titles);
    for (const FaultRow& row : m_rows) {
        std::vector<std::string> numbers;
        for (int column = kThisComputer; column <= kLost; ++column) {
            numbers.push_back(std::to_string(lostIn(row, column)));
        }
        numbers.push_back(std::to_string(row.counts.expected));
        const bool isOfOne = row.kind == FaultRow::Character || row.kind == FaultRow::Stream;
        const QString name =
            isOfOne ? QString::fromStdString(namesBeside(m_view).roster().displayName(row.current).csv())
                    : nameOf(row);
        text += line(
            {isOfOne ? QString::number(row.current.character) : QString(), name,
             row.kind == FaultRow::Stream ? QString::fromStdString(wire::typeDigits(row.type)) : QString()},
            numbers);
    }
    return QString::fromStdString(text);
}

QVariant FaultModel::data(const QModelIndex& index, int role) const {
    return checkIndex(index, CheckIndexOption::IndexIsValid) ? cell(row(index), index.column(), role)
                                                             : QVariant();
}

} // namespace posewire::gui
