// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/packet_view.h"

#include "app/gui/models/column.h"
#include "app/gui/models/packet_model.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/panels/table_view.h"
#include "app/gui/theme/theme.h"

#include <QContextMenuEvent>
#include <QPainter>
#include <QScopedValueRollback>

#include <algorithm>

namespace posewire::gui {

namespace {

/// Measuring takes longer than drawing: only what may be too long is measured.
QString fitting(const QFontMetrics& metrics, const QString& text, int width) {
    const bool isShort = text.size() * metrics.maxWidth() <= width;
    return isShort ? text : metrics.elidedText(text, Qt::ElideRight, width);
}

/// Not the delegate's way, which measures every text: ten times slower.
void paintPacketCell(QPainter& painter, const QModelIndex& index, QRect rect, bool isSelected) {
    const QString text = index.data(Qt::DisplayRole).toString();
    if (text.isEmpty()) {
        return;
    }
    const QFontMetrics metrics = painter.fontMetrics();
    if (const QVariant dot = index.data(kDotRole); dot.isValid()) {
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
    if (const QString suffix = index.data(kSuffixRole).toString(); !suffix.isEmpty()) {
        rect.setLeft(rect.left() + metrics.horizontalAdvance(shown + QLatin1Char(' ')));
        painter.setPen(isSelected ? onSelection(theme().dim) : theme().dim);
        painter.drawText(rect, Qt::AlignLeft | Qt::AlignVCenter, fitting(metrics, suffix, rect.width()));
    }
}

} // namespace

QFont packetFont() {
    constexpr qreal kScale = 0.92; // ten columns beside each other
    QFont font = monospaceFont();
    font.setPointSizeF(font.pointSizeF() * kScale);
    return font;
}

PacketView::PacketView(const QString& name, QWidget* parent)
    : QAbstractItemView(parent), m_header(new FittingHeader(this, packetFont, 2, FittingHeader::Kept::Open)) {
    installPacketAccessible();
    setAccessibleName(name);
    setFrameShape(QFrame::NoFrame);
    setSelectionMode(ExtendedSelection);
    setSelectionBehavior(SelectRows);
    setTabKeyNavigation(false);
    setEditTriggers(NoEditTriggers);
    setVerticalScrollMode(ScrollPerItem);
    setHorizontalScrollMode(ScrollPerPixel);
    setCornerWidget(new QWidget(this));
    m_newest->setObjectName(QStringLiteral("newestPacket"));
    m_newest->setToolTip(tr("Go to the newest packet and follow (Ctrl+End)"));
    m_newest->setFocusPolicy(Qt::NoFocus); // Ctrl+End does the same
    m_newest->hide();
    connect(m_newest, &QPushButton::clicked, this, &PacketView::newestRequested);
    connect(m_header, &QHeaderView::sectionResized, this, [this] {
        if (!m_header->isFitting()) { // scroll bars would come and go, and take width meanwhile
            updateGeometries();
        }
    });
    connect(m_header, &FittingHeader::fitted, this, &PacketView::updateGeometries);
    connect(verticalScrollBar(), &QScrollBar::valueChanged, this, [this](int value) {
        if (!m_isAdjusting) {
            setFollowing(value >= verticalScrollBar()->maximum());
        }
    });
}

void PacketView::setModel(QAbstractItemModel* model) {
    QAbstractItemView::setModel(model);
    m_header->setModel(model);
    connect(model, &QAbstractItemModel::rowsInserted, this, [this](const QModelIndex&, int first, int last) {
        m_missed += m_isFollowing || m_isCatchingUp ? 0 : static_cast<std::uint64_t>(last - first + 1);
        layOut();
    });
    connect(model, &QAbstractItemModel::rowsRemoved, this, [this](const QModelIndex&, int first, int last) {
        if (first == 0 && !m_isFollowing) {
            const QScopedValueRollback guard(m_isAdjusting, true);
            verticalScrollBar()->setValue(topRow() - (last - first + 1));
        }
        layOut();
    });
    connect(model, &QAbstractItemModel::modelReset, this, [this] {
        m_missed = 0;
        layOut();
    });
}

void PacketView::setEmptyText(const QString& text) {
    if (text != m_emptyText) {
        m_emptyText = text;
        layOut();
    }
}

/// After a change of the rows.
void PacketView::layOut() {
    if (rowCount() > 0) {
        m_header->keepWhole(model()->index(rowCount() - 1, 0)); // the newest row has the longest figures
    }
    if (const QString text = rowCount() == 0 ? m_emptyText : QString(); text != accessibleDescription()) {
        setAccessibleDescription(text);
    }
    updateGeometries();
}

void PacketView::updateGeometries() {
    m_rowHeight = CellDelegate::rowHeight(fontMetrics());
    setViewportMargins(0, m_rowHeight + 1, 0, 0);
    m_header->setGeometry(viewport()->x(), viewport()->y() - m_rowHeight - 1, viewport()->width(),
                          m_rowHeight + 1);
    const QScopedValueRollback guard(m_isAdjusting, true);
    verticalScrollBar()->setSingleStep(1);
    verticalScrollBar()->setPageStep(wholeRows());
    verticalScrollBar()->setRange(0, std::max(0, rowCount() - wholeRows()));
    horizontalScrollBar()->setSingleStep(fontMetrics().averageCharWidth() * 4);
    horizontalScrollBar()->setPageStep(viewport()->width());
    horizontalScrollBar()->setRange(0, std::max(0, m_header->length() - viewport()->width()));
    if (m_isFollowing) {
        verticalScrollBar()->setValue(verticalScrollBar()->maximum());
    }
    m_newest->setVisible(!m_isFollowing && rowCount() > 0);
    const QString count = grouped(m_missed);
    const QStringList words = m_missed == 0 ? QStringList{tr("↓ Follow"), tr("↓")}
                                            : QStringList{tr("↓ %1 new").arg(count), tr("↓ %1").arg(count)};
    // In the line of column titles it covers no row; if it would cover a title even in few words, it lies on
    // the last row.
    if (!m_newest->isHidden() && !m_header->seat(*m_newest, words)) {
        m_newest->move(m_newest->x(), viewport()->geometry().bottom() - m_newest->height());
    }
    QAbstractItemView::updateGeometries();
    viewport()->update();
}

void PacketView::setFollowing(bool isFollowing) {
    m_missed = isFollowing == m_isFollowing ? m_missed : 0;
    m_isFollowing = isFollowing;
    updateGeometries();
}

void PacketView::showRow(int row) {
    const QModelIndex shown = model()->index(row, std::max(0, currentIndex().column()));
    if (shown.isValid()) {
        setFollowing(false);
        selectionModel()->setCurrentIndex(shown,
                                          QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
        scrollTo(shown);
    }
}

QRect PacketView::visualRect(const QModelIndex& index) const {
    if (!index.isValid()) {
        return {};
    }
    const std::int64_t top = (std::int64_t{index.row()} - topRow()) * m_rowHeight;
    // Rows far outside would not fit into the coordinates of a widget.
    const auto y =
        static_cast<int>(std::clamp<std::int64_t>(top, -m_rowHeight - 1, viewport()->height() + 1));
    return {m_header->sectionViewportPosition(index.column()), y, m_header->sectionSize(index.column()),
            m_rowHeight};
}

bool PacketView::isShown(const QModelIndex& index) const {
    return index.isValid() && index.row() >= topRow() && index.row() < topRow() + wholeRows();
}

void PacketView::scrollTo(const QModelIndex& index, ScrollHint hint) {
    if (!index.isValid() || (isShown(index) && hint == EnsureVisible)) {
        return;
    }
    const int row = index.row();
    // A row next to the shown ones scrolls by little; one from elsewhere is shown among its neighbours.
    const bool isNear = row >= topRow() - wholeRows() && row < topRow() + 2 * wholeRows();
    const bool isToTop = hint == PositionAtTop || (isNear && row < topRow());
    const bool isToBottom = hint == PositionAtBottom || isNear;
    verticalScrollBar()->setValue(isToTop ? row : isToBottom ? row - wholeRows() + 1 : row - wholeRows() / 2);
}

QModelIndex PacketView::indexAt(const QPoint& point) const {
    return rowCount() == 0 || point.y() < 0
               ? QModelIndex()
               : model()->index(topRow() + point.y() / m_rowHeight,
                                std::max(0, m_header->logicalIndexAt(point.x())));
}

/// By keyboard the menu belongs to the current row, not to where the pointer happens to be.
void PacketView::contextMenuEvent(QContextMenuEvent* event) {
    if (event->reason() != QContextMenuEvent::Keyboard) {
        emit menuRequested(event->globalPos());
        return;
    }
    scrollTo(currentIndex());
    const QRect cell = visualRect(currentIndex());
    const int x = std::clamp(cell.left(), 0, std::max(0, viewport()->width() - m_rowHeight));
    emit menuRequested(viewport()->mapToGlobal(cell.isNull() ? QPoint(0, 0) : QPoint(x, cell.bottom())));
}

QModelIndex PacketView::moveCursor(CursorAction action, Qt::KeyboardModifiers /*modifiers*/) {
    const int rows = rowCount();
    if (rows == 0) {
        return {};
    }
    const QModelIndex current = currentIndex();
    const int row = current.isValid() ? current.row() : std::min(topRow() + wholeRows() - 1, rows - 1);
    const int column = std::max(0, current.column());
    const int one = current.isValid() ? 1 : 0;
    const int page = wholeRows() - 1;
    const std::pair<CursorAction, int> moves[] = {{MoveUp, -one},      {MoveDown, one},
                                                  {MovePageUp, -page}, {MovePageDown, page},
                                                  {MoveHome, -row},    {MoveEnd, rows - 1 - row}};
    const auto move = std::ranges::find(moves, action, &std::pair<CursorAction, int>::first);
    if (move != std::end(moves)) {
        return model()->index(std::clamp(row + move->second, 0, rows - 1), column);
    }
    const bool isBack = action == MoveLeft || action == MovePrevious;
    return model()->index(row, m_header->columnBeside(column, isBack ? -1 : 1));
}

void PacketView::setSelection(const QRect& rect, QItemSelectionModel::SelectionFlags flags) {
    const int last = rowCount() - 1;
    const auto rowAt = [&](int y) { return topRow() + (y < 0 ? -1 : y / m_rowHeight); };
    QItemSelection selection;
    if (rowAt(rect.top()) <= last) {
        selection.select(
            model()->index(std::max(0, rowAt(rect.top())), 0),
            model()->index(std::clamp(rowAt(rect.bottom()), 0, last), model()->columnCount() - 1));
    }
    selectionModel()->select(selection, flags);
}

void PacketView::scrollContentsBy(int dx, int /*dy*/) {
    if (dx != 0) {
        m_header->setOffset(horizontalScrollBar()->value());
    }
    viewport()->update();
}

void PacketView::focusInEvent(QFocusEvent* event) {
    if (event->reason() == Qt::ActiveWindowFocusReason || event->reason() == Qt::PopupFocusReason) {
        QAbstractScrollArea::focusInEvent(event);
        viewport()->update();
    } else {
        QAbstractItemView::focusInEvent(event);
    }
}

void PacketView::paintEvent(QPaintEvent* event) {
    if (rowCount() == 0) {
        drawEmptyText(*viewport(), m_emptyText);
        return;
    }
    QPainter painter(viewport());
    painter.setFont(packetFont());
    const int last = std::min(topRow() + event->rect().bottom() / m_rowHeight, rowCount() - 1);
    for (int row = topRow() + event->rect().top() / m_rowHeight; row <= last; ++row) {
        paintRow(painter, row);
    }
}

void PacketView::paintRow(QPainter& painter, int row) const {
    const QModelIndex begin = model()->index(row, 0);
    const QRect rect(0, (row - topRow()) * m_rowHeight, viewport()->width(), m_rowHeight);
    const bool isSelected = selectionModel()->isSelected(begin);
    if (isSelected) {
        painter.fillRect(rect, theme().selection);
    } else if (begin.data(kStripeRole).toBool()) {
        painter.fillRect(rect, palette().brush(QPalette::AlternateBase));
    }
    for (int column = 0; column < model()->columnCount(); ++column) {
        const QModelIndex cell = begin.siblingAtColumn(column);
        QRect room = visualRect(cell);
        // Words run on over empty cells beside them.
        for (int beside = column, next = m_header->columnBeside(column, 1);
             next != beside && !room.isEmpty() && !CellDelegate::isNumber(cell) &&
             cell.siblingAtColumn(next).data().toString().isEmpty();
             beside = next, next = m_header->columnBeside(next, 1)) {
            room.setRight(room.right() + m_header->sectionSize(next));
        }
        if (room.intersects(rect)) {
            const int margin = CellDelegate::margin(fontMetrics());
            paintPacketCell(painter, cell, room.adjusted(margin, 0, -margin, 0), isSelected);
        }
    }
    if (hasFocus() && currentIndex().row() == row) {
        painter.setPen(theme().accent);
        painter.setBrush(Qt::NoBrush);
        painter.drawRect(visualRect(currentIndex()).adjusted(0, 0, -1, -1));
    }
    if (begin.data(kPausedHereRole).toBool()) {
        painter.fillRect(QRect(rect.left(), rect.bottom() - 1, rect.width(), 2), theme().accent);
    }
}

} // namespace posewire::gui
