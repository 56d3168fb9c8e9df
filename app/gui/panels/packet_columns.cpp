// SPDX-License-Identifier: GPL-3.0-or-later
// Which columns the list of packets has, and how wide they are.
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/panels/packet_view.h"

#include <QHeaderView>
#include <QMenu>
#include <QScopedValueRollback>

#include <algorithm>

namespace posewire::gui {

void PacketView::setColumnSamples(std::vector<QString> samples) {
    m_samples = std::move(samples);
    fitColumns();
}

void PacketView::setColumnUseful(int column, bool isUseful) {
    if (m_useless.contains(column) == isUseful) {
        isUseful ? static_cast<void>(m_useless.removeAll(column)) : m_useless.append(column);
        fitColumns();
    }
}

void PacketView::setGivingWay(std::vector<int> columns) {
    m_givingWay = std::move(columns);
    fitColumns();
}

void PacketView::setChosenColumns(const QList<int>& columns) {
    m_chosen = columns;
    fitColumns();
}

int PacketView::sampleWidth(int column) const {
    const QString title = model()->headerData(column, Qt::Horizontal, Qt::DisplayRole).toString();
    const int margins = 2 * CellDelegate::margin(fontMetrics()) + 2;
    const int text =
        QFontMetrics(packetFont()).horizontalAdvance(m_samples[static_cast<std::size_t>(column)]);
    return std::max(text + margins, fontMetrics().horizontalAdvance(title) + 14);
}

int PacketView::leastOpenWidth() const {
    return fontMetrics().averageCharWidth() * 22;
}

std::vector<bool> PacketView::shownColumns(int open) const {
    std::vector<bool> isShown(m_samples.size(), true);
    int width = leastOpenWidth();
    for (int column = 0; column < static_cast<int>(m_samples.size()); ++column) {
        const auto place = static_cast<std::size_t>(column);
        isShown[place] =
            column == open || (m_chosen.isEmpty() ? !m_useless.contains(column) : m_chosen.contains(column));
        width += isShown[place] && column != open ? sampleWidth(column) : 0;
    }
    for (const int column : m_givingWay) {
        const auto place = static_cast<std::size_t>(column);
        if (m_chosen.isEmpty() && width > viewport()->width() && isShown[place]) {
            isShown[place] = false;
            width -= sampleWidth(column);
        }
    }
    return isShown;
}

void PacketView::fitColumns() {
    const auto empty = std::ranges::find(m_samples, QString());
    if (model() == nullptr || empty == m_samples.end() || m_isFitting) {
        return; // sections that change their size ask for this again
    }
    const QScopedValueRollback guard(m_isFitting, true);
    const auto open = static_cast<int>(empty - m_samples.begin());
    const std::vector<bool> isShown = shownColumns(open);
    for (int column = 0; column < static_cast<int>(m_samples.size()); ++column) {
        const bool isColumnShown = isShown[static_cast<std::size_t>(column)];
        if (m_header->isSectionHidden(column) == isColumnShown) {
            m_header->setSectionHidden(column, !isColumnShown);
        }
        if (isColumnShown && column != open) {
            m_header->resizeSection(column, sampleWidth(column));
        }
    }
    const int others = m_header->length() - m_header->sectionSize(open);
    m_header->resizeSection(open, std::max(leastOpenWidth(), viewport()->width() - others));
    viewport()->update();
}

int PacketView::columnBeside(int column, int direction) const {
    for (int beside = column + direction; beside >= 0 && beside < m_header->count(); beside += direction) {
        if (!m_header->isSectionHidden(beside)) {
            return beside;
        }
    }
    return column;
}

void PacketView::showHeaderMenu(const QPoint& at) {
    QMenu menu(this);
    QAction* fitting = menu.addAction(tr("As many columns as fit"));
    fitting->setCheckable(true);
    fitting->setChecked(m_chosen.isEmpty());
    menu.addSeparator();
    QList<int> shown;
    for (int column = 0; column < model()->columnCount(); ++column) {
        QAction* action = menu.addAction(model()->headerData(column, Qt::Horizontal).toString());
        action->setCheckable(true);
        action->setChecked(!m_header->isSectionHidden(column));
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
    setChosenColumns(shown);
}

} // namespace posewire::gui
