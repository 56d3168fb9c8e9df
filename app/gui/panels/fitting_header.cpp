// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/fitting_header.h"

#include "app/gui/panels/cell_delegate.h"
#include "app/gui/panels/packet_view.h"

#include <QMenu>
#include <QScopedValueRollback>

#include <algorithm>

namespace posewire::gui {

FittingHeader::FittingHeader(QWidget* table) : QHeaderView(Qt::Horizontal, table) {
    setStretchLastSection(false);
    setMinimumSectionSize(0);
    setHighlightSections(false);
    setTextElideMode(Qt::ElideRight);
    setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    setContextMenuPolicy(Qt::CustomContextMenu);
    connect(this, &QWidget::customContextMenuRequested, this,
            [this](const QPoint& at) { openMenu(mapToGlobal(at)); });
}

void FittingHeader::setSamples(std::vector<QString> samples) {
    m_samples = std::move(samples);
    fit(m_width);
}

void FittingHeader::setUseful(int column, bool isUseful) {
    if (m_useless.contains(column) == isUseful) {
        isUseful ? static_cast<void>(m_useless.removeAll(column)) : m_useless.append(column);
        fit(m_width);
    }
}

void FittingHeader::setGivingWay(std::vector<int> columns) {
    m_givingWay = std::move(columns);
    fit(m_width);
}

void FittingHeader::setChosen(const QList<int>& columns) {
    m_chosen = columns;
    fit(m_width);
}

int FittingHeader::sampleWidth(int column) const {
    const QString title = model()->headerData(column, Qt::Horizontal, Qt::DisplayRole).toString();
    const int margins = 2 * CellDelegate::margin(parentWidget()->fontMetrics()) + 2;
    const int text =
        QFontMetrics(packetFont()).horizontalAdvance(m_samples[static_cast<std::size_t>(column)]);
    return std::max(text + margins, parentWidget()->fontMetrics().horizontalAdvance(title) + 14);
}

int FittingHeader::leastOpenWidth() const {
    return parentWidget()->fontMetrics().averageCharWidth() * 22;
}

std::vector<bool> FittingHeader::shownColumns(int open) const {
    std::vector<bool> isShown(m_samples.size(), true);
    int needed = leastOpenWidth();
    for (int column = 0; column < static_cast<int>(m_samples.size()); ++column) {
        const auto place = static_cast<std::size_t>(column);
        isShown[place] =
            column == open || (m_chosen.isEmpty() ? !m_useless.contains(column) : m_chosen.contains(column));
        needed += isShown[place] && column != open ? sampleWidth(column) : 0;
    }
    for (const int column : m_givingWay) {
        const auto place = static_cast<std::size_t>(column);
        if (m_chosen.isEmpty() && needed > m_width && isShown[place]) {
            isShown[place] = false;
            needed -= sampleWidth(column);
        }
    }
    return isShown;
}

void FittingHeader::fit(int width) {
    m_width = width;
    const auto empty = std::ranges::find(m_samples, QString());
    if (model() == nullptr || empty == m_samples.end() || m_isFitting) {
        return; // sections that change their size ask for this again
    }
    const QScopedValueRollback guard(m_isFitting, true);
    const auto open = static_cast<int>(empty - m_samples.begin());
    const std::vector<bool> isShown = shownColumns(open);
    for (int column = 0; column < static_cast<int>(m_samples.size()); ++column) {
        const bool isColumnShown = isShown[static_cast<std::size_t>(column)];
        if (isSectionHidden(column) == isColumnShown) {
            setSectionHidden(column, !isColumnShown);
        }
        if (isColumnShown && column != open) {
            resizeSection(column, sampleWidth(column));
        }
    }
    const int others = length() - sectionSize(open);
    resizeSection(open, std::max(leastOpenWidth(), m_width - others));
}

int FittingHeader::columnBeside(int column, int direction) const {
    for (int beside = column + direction; beside >= 0 && beside < count(); beside += direction) {
        if (!isSectionHidden(beside)) {
            return beside;
        }
    }
    return column;
}

void FittingHeader::openMenu(const QPoint& at) {
    QMenu menu(this);
    QAction* fitting = menu.addAction(tr("As many columns as fit"));
    fitting->setCheckable(true);
    fitting->setChecked(m_chosen.isEmpty());
    menu.addSeparator();
    QList<int> shown;
    for (int column = 0; column < model()->columnCount(); ++column) {
        QAction* action = menu.addAction(model()->headerData(column, Qt::Horizontal).toString());
        action->setCheckable(true);
        action->setChecked(!isSectionHidden(column));
        action->setEnabled(!m_samples[static_cast<std::size_t>(column)].isEmpty());
        action->setData(column);
        if (action->isChecked()) {
            shown.append(column);
        }
    }
    const QAction* chosen = menu.exec(at);
    if (chosen == nullptr) {
        return;
    }
    const int column = chosen->data().toInt();
    if (chosen == fitting) {
        shown.clear();
    } else if (!shown.removeOne(column)) {
        shown.append(column);
    }
    setChosen(shown);
}

} // namespace posewire::gui
