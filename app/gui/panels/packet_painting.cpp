// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/column.h"
#include "app/gui/models/packet_model.h"
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/panels/fitting_header.h"
#include "app/gui/panels/packet_view.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/theme/theme.h"

#include <QPaintEvent>
#include <QPainter>

#include <algorithm>

namespace posewire::gui {

namespace {

/// Measuring takes longer than drawing: only what may be too long is measured.
QString fitting(const QFontMetrics& metrics, const QString& text, int width) {
    if (text.size() * metrics.maxWidth() <= width) {
        return text;
    }
    return metrics.elidedText(text, Qt::ElideRight, width);
}

} // namespace

void PacketView::paintEvent(QPaintEvent* event) {
    const int rows = model() == nullptr ? 0 : model()->rowCount();
    if (rows == 0) {
        drawEmptyText(*viewport(), m_emptyText);
        return;
    }
    QPainter painter(viewport());
    painter.setFont(packetFont());
    const int height = rowHeight();
    const int first = topRow() + event->rect().top() / height;
    const int last = std::min(topRow() + event->rect().bottom() / height, rows - 1);
    for (int row = first; row <= last; ++row) {
        paintRow(painter, row, QRect(0, (row - topRow()) * height, viewport()->width(), height));
    }
}

void PacketView::paintRow(QPainter& painter, int row, const QRect& rect) const {
    const QModelIndex begin = model()->index(row, 0);
    const bool isSelected = selectionModel()->isSelected(begin);
    if (isSelected) {
        painter.fillRect(rect, theme().selection);
    } else if (begin.data(kStripeRole).toBool()) {
        painter.fillRect(rect, palette().brush(QPalette::AlternateBase));
    }
    for (int column = 0; column < model()->columnCount(); ++column) {
        const QRect cell = roomOf(model()->index(row, column));
        if (cell.intersects(viewport()->rect())) {
            paintCell(painter, model()->index(row, column), cell, isSelected);
        }
    }
    const QModelIndex current = currentIndex();
    if (hasFocus() && current.row() == row) {
        painter.setPen(theme().accent);
        painter.setBrush(Qt::NoBrush);
        painter.drawRect(visualRect(current).adjusted(0, 0, -1, -1));
    }
    if (begin.data(kPausedHereRole).toBool()) {
        painter.fillRect(QRect(rect.left(), rect.bottom() - 1, rect.width(), 2), theme().accent);
    }
}

/// Words run on over empty cells beside them.
QRect PacketView::roomOf(const QModelIndex& index) const {
    QRect room = visualRect(index);
    if (room.isEmpty() || CellDelegate::isNumber(index)) {
        return room;
    }
    for (int last = index.column(), beside = m_header->columnBeside(last, 1);
         beside != last && index.siblingAtColumn(beside).data().toString().isEmpty();
         last = beside, beside = m_header->columnBeside(last, 1)) {
        room.setRight(room.right() + m_header->sectionSize(beside));
    }
    return room;
}

void PacketView::paintCell(QPainter& painter, const QModelIndex& index, QRect rect, bool isSelected) const {
    const QString text = index.data(Qt::DisplayRole).toString();
    if (text.isEmpty()) {
        return;
    }
    const int margin = CellDelegate::margin(fontMetrics());
    rect.adjust(margin, 0, -margin, 0);
    const QFontMetrics metrics = painter.fontMetrics();
    const QVariant dot = index.data(kDotRole);
    if (dot.isValid()) {
        const int side = std::max(7, metrics.ascent() * 2 / 3);
        rect.setLeft(rect.left() +
                     CellDelegate::paintBefore(painter, rect, side, dot.value<CharacterMark>()));
    }
    const QVariant colour = index.data(Qt::ForegroundRole);
    const QColor pen = colour.isValid() ? colour.value<QColor>() : theme().text;
    painter.setPen(isSelected ? onSelection(pen) : pen);
    const QString shown = fitting(metrics, text, rect.width());
    painter.drawText(
        rect, (CellDelegate::isNumber(index) ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter, shown);
    const QString suffix = index.data(kSuffixRole).toString();
    if (!suffix.isEmpty()) {
        rect.setLeft(rect.left() + metrics.horizontalAdvance(shown + QLatin1Char(' ')));
        painter.setPen(isSelected ? onSelection(theme().dim) : theme().dim);
        painter.drawText(rect, Qt::AlignLeft | Qt::AlignVCenter, fitting(metrics, suffix, rect.width()));
    }
}

} // namespace posewire::gui
