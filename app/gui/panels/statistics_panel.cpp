// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/statistics_panel.h"

#include "app/gui/models/shown_character.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/line.h"

#include <QVBoxLayout>

namespace posewire::gui {

StatisticsPanel::StatisticsPanel(model::SessionView& view, Commands& commands, QWidget* parent)
    : Panel(parent),
      m_view(view),
      m_commands(commands),
      m_streams(view),
      m_receiver(receiverFacts(view)),
      m_table(new TableView(tr("Statistics of streams"), this)),
      m_facts(new TableView(tr("This computer"), this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins({});
    layout->setSpacing(0);
    layout->addWidget(m_table, 1);
    layout->addWidget(new Line(this));
    layout->addWidget(m_facts);
    m_table->setModel(&m_streams);
    const QString number = QStringLiteral("9999.99");
    m_table->setColumnSamples({QString(), QStringLiteral("9999.9"), QStringLiteral("0000000"),
                               QStringLiteral("▲ 9999"), number, number, number, number,
                               QStringLiteral("9999.9"), QStringLiteral("99 999 999"),
                               QStringLiteral("■ 9999")},
                              QStringLiteral("● Mira Lindqvist 02"));
    m_table->setOptionalColumns(StatisticsModel::kDeviation);
    m_table->setEmptyText(tr("No stream on the air.\nRates, spacing and gaps of every stream show here."));
    m_facts->setModel(&m_receiver);
    m_facts->setHeaderHidden(true);
    m_facts->setColumnSamples({QStringLiteral("Foreign datagrams"), QString()});
    m_facts->setFixedHeight(m_facts->heightForRows(m_receiver.rowCount()));
    m_facts->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    connect(m_table, &QAbstractItemView::clicked, this, &StatisticsPanel::select);
    connect(m_table, &QAbstractItemView::activated, this, &StatisticsPanel::select);
    for (TableView* table : {m_table, m_facts}) {
        connect(table, &TableView::copyRequested, this,
                [this](const QString& text) { m_commands.copyText(text); });
    }
}

void StatisticsPanel::refresh() {
    m_streams.refresh();
    m_receiver.refresh();
}

QString StatisticsPanel::summary() const {
    const std::size_t count = m_view.streams().size();
    if (count == 0) {
        return {};
    }
    return count == 1 ? tr("1 stream") : tr("%1 streams").arg(count);
}

QJsonObject StatisticsPanel::state() const {
    const QJsonArray columns = m_table->chosenColumns();
    return columns.isEmpty() ? QJsonObject() : QJsonObject{{"columns", columns}};
}

void StatisticsPanel::restoreState(const QJsonObject& state) {
    m_table->setChosenColumns(state["columns"].toArray());
}

void StatisticsPanel::select(const QModelIndex& index) {
    const log::StreamKey& key = m_streams.stream(index.row()).key;
    m_commands.select(selectionOf(m_view, {key.source, key.character}));
}

} // namespace posewire::gui
