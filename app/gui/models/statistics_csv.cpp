// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/csv_cell.h"
#include "app/gui/models/shown_character.h"
#include "app/gui/models/statistics_model.h"
#include "core/wire/type_table.h"

#include <QStringList>

namespace posewire::gui {

namespace {

QString lineOf(model::SessionView& view, const model::Stream& stream, const model::StreamFigures& figures) {
    const model::CharacterKey key{stream.key.sender, stream.key.character};
    const model::Sender* sender = view.find(key.sender);
    const auto digits = wire::typeDigits(stream.key.type);
    QStringList cells{sender == nullptr ? QString() : csvCell(QString::fromStdString(sender->info.address)),
                      QString::number(key.character), csvCell(characterName(view, key)),
                      QString::fromLatin1(digits.data(), 2)};
    for (int column = 0; column < kStatisticsColumns; ++column) {
        if (const auto figure = figureIn(column)) {
            cells += statisticsNumber(figures, *figure);
        }
    }
    return cells.join(QLatin1Char(','));
}

} // namespace

QString StatisticsModel::csv() const {
    QStringList titles{tr("Sender"), tr("Character"), tr("Name"), tr("Type")};
    for (int column = 0; column < kStatisticsColumns; ++column) {
        if (figureIn(column)) {
            titles += csvCell(headerData(column, Qt::Horizontal, Qt::DisplayRole).toString());
        }
    }
    QString text = titles.join(QLatin1Char(',')) + QStringLiteral("\r\n");
    for (int i = 0; i < rowCount(); ++i) {
        const QModelIndex sender = index(i, 0);
        for (int j = 0; j < rowCount(sender); ++j) {
            const QModelIndex character = index(j, 0, sender);
            for (int k = 0; k < rowCount(character); ++k) {
                const QModelIndex row = index(k, 0, character);
                text += lineOf(view(), *stream(row), figures(row)) + QStringLiteral("\r\n");
            }
        }
    }
    return text;
}

} // namespace posewire::gui
