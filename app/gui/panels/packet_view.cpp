// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/packet_view.h"

#include "app/gui/models/column.h"
#include "app/gui/models/packet_model.h"
#include "app/gui/models/text.h"
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/panels/fitting_header.h"
#include "app/gui/theme/theme.h"

#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QScrollBar>

#include <algorithm>

namespace posewire::gui {

namespace {

bool wantsNewest(const QKeyEvent& event) {
    return event.key() == Qt::Key_End && event.modifiers() == Qt::ControlModifier;
}

} // namespace

QFont packetFont() {
    constexpr qreal kScale = 0.92; // ten columns beside each other
    QFont font = monospaceFont();
    font.setPointSizeF(font.pointSizeF() * kScale);
    return font;
}

PacketView::PacketView(const QString& name, QWidget* parent)
    : QAbstractItemView(parent),
      m_header(new FittingHeader(this, packetFont, 2, FittingHeader::Kept::Open)),
      m_newest(new QPushButton(this)) {
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
    m_newest->setFocusPolicy(Qt::NoFocus); // Ctrl+End does the same
    m_newest->hide();
    connect(m_newest, &QPushButton::clicked, this, &PacketView::newestRequested);
    const auto placeAll = [this] {
        updateGeometries();
        viewport()->update();
    };
    connect(m_header, &QHeaderView::sectionResized, this, [this, placeAll] {
        if (!m_header->isFitting()) { // scroll bars would come and go, and take width meanwhile
            placeAll();
        }
    });
    connect(m_header, &FittingHeader::fitted, this, placeAll);
    connect(verticalScrollBar(), &QScrollBar::valueChanged, this, [this](int value) {
        if (!m_isAdjusting) {
            noteFollowing(value >= verticalScrollBar()->maximum());
        }
    });
}

void PacketView::setModel(QAbstractItemModel* model) {
    QAbstractItemView::setModel(model);
    m_header->setModel(model);
    connect(model, &QAbstractItemModel::rowsInserted, this,
            [this](const QModelIndex&, int first, int last) { onRowsInserted(last - first + 1); });
    connect(model, &QAbstractItemModel::rowsRemoved, this,
            [this](const QModelIndex&, int first, int last) { onRowsRemoved(first, last - first + 1); });
    connect(model, &QAbstractItemModel::modelReset, this, &PacketView::onReset);
}

void PacketView::setEmptyText(const QString& text) {
    if (text != m_emptyText) {
        m_emptyText = text;
        describe();
        viewport()->update();
    }
}

/// Only while it is empty it is said what to do.
void PacketView::describe() {
    const bool isEmpty = model() == nullptr || model()->rowCount() == 0;
    setAccessibleDescription(isEmpty ? m_emptyText : QString());
}

int PacketView::rowsInSight() const {
    const int rows = model() == nullptr ? 0 : model()->rowCount();
    return std::clamp(rows - topRow(), 0, wholeRows());
}

int PacketView::rowHeight() const {
    return CellDelegate::rowHeight(fontMetrics());
}

int PacketView::topRow() const {
    return verticalScrollBar()->value();
}

int PacketView::wholeRows() const {
    return std::max(1, viewport()->height() / rowHeight());
}

void PacketView::updateGeometries() {
    const int height = rowHeight() + 1;
    setViewportMargins(0, height, 0, 0);
    m_header->setGeometry(viewport()->x(), viewport()->y() - height, viewport()->width(), height);
    fitScrollBars();
    placeButton();
    QAbstractItemView::updateGeometries();
}

void PacketView::fitScrollBars() {
    const QScopedValueRollback guard(m_isAdjusting, true);
    const int rows = model() == nullptr ? 0 : model()->rowCount();
    verticalScrollBar()->setSingleStep(1);
    verticalScrollBar()->setPageStep(wholeRows());
    verticalScrollBar()->setRange(0, std::max(0, rows - wholeRows()));
    horizontalScrollBar()->setSingleStep(fontMetrics().averageCharWidth() * 4);
    horizontalScrollBar()->setPageStep(viewport()->width());
    horizontalScrollBar()->setRange(0, std::max(0, m_header->length() - viewport()->width()));
    if (m_isFollowing) {
        verticalScrollBar()->setValue(verticalScrollBar()->maximum());
    }
}

/// Rows that nobody sees are not looked at: there may be millions.
void PacketView::dataChanged(const QModelIndex& topLeft, const QModelIndex& bottomRight,
                             const QList<int>& roles) {
    const int first = std::max(topLeft.row(), topRow());
    const int last = std::min(bottomRight.row(), topRow() + wholeRows());
    if (topLeft.isValid() && bottomRight.isValid() && first <= last) {
        QAbstractItemView::dataChanged(topLeft.siblingAtRow(first), bottomRight.siblingAtRow(last), roles);
    }
}

void PacketView::onRowsInserted(int count) {
    m_missed += m_isFollowing || m_isCatchingUp ? 0 : static_cast<std::uint64_t>(count);
    keepFigures();
    fitScrollBars();
    placeButton();
    describe();
    viewport()->update();
}

void PacketView::onRowsRemoved(int first, int count) {
    const QScopedValueRollback guard(m_isAdjusting, true);
    if (first == 0 && !m_isFollowing) {
        verticalScrollBar()->setValue(topRow() - count);
    }
    fitScrollBars();
    describe();
    viewport()->update();
}

/// The newest row has the longest ones.
void PacketView::keepFigures() {
    m_header->keepWhole(model()->index(model()->rowCount() - 1, 0));
}

void PacketView::onReset() {
    m_missed = 0;
    keepFigures();
    describe();
    fitScrollBars();
    placeButton();
    viewport()->update();
}

void PacketView::noteFollowing(bool isFollowing) {
    if (isFollowing != m_isFollowing) {
        m_isFollowing = isFollowing;
        m_missed = 0;
        placeButton();
    }
}

void PacketView::setFollowing(bool isFollowing) {
    noteFollowing(isFollowing);
    fitScrollBars();
}

void PacketView::placeButton() {
    const bool isShown = !m_isFollowing && model() != nullptr && model()->rowCount() > 0;
    m_newest->setVisible(isShown);
    if (!isShown) {
        return;
    }
    m_newest->setToolTip(tr("Go to the newest packet and follow (Ctrl+End)"));
    // In the line of column titles it covers no row; where it would cover a title even in few words, it lies
    // on the last row.
    const QString count = grouped(m_missed);
    if (!m_header->seat(*m_newest, m_missed == 0
                                       ? QStringList{tr("↓ Follow"), tr("↓")}
                                       : QStringList{tr("↓ %1 new").arg(count), tr("↓ %1").arg(count)})) {
        m_newest->move(m_newest->x(), viewport()->geometry().bottom() - m_newest->height());
    }
}

void PacketView::showRow(int row) {
    const QModelIndex shown = model()->index(row, std::max(0, currentIndex().column()));
    if (!shown.isValid()) {
        return;
    }
    setFollowing(false);
    selectionModel()->setCurrentIndex(shown, QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
    scrollTo(shown);
}

std::vector<int> PacketView::selectedRows(std::size_t most) const {
    std::vector<std::pair<int, int>> ranges;
    for (const QItemSelectionRange& range : selectionModel()->selection()) {
        ranges.emplace_back(range.top(), range.bottom());
    }
    std::ranges::sort(ranges);
    std::vector<int> rows;
    for (const auto& [first, last] : ranges) {
        for (int row = first; row <= last && rows.size() < most; ++row) {
            rows.push_back(row);
        }
    }
    return rows;
}

QRect PacketView::visualRect(const QModelIndex& index) const {
    if (!index.isValid()) {
        return {};
    }
    const std::int64_t top = (std::int64_t{index.row()} - topRow()) * rowHeight();
    // Rows far outside would not fit into the coordinates of a widget.
    const auto y =
        static_cast<int>(std::clamp<std::int64_t>(top, -rowHeight() - 1, viewport()->height() + 1));
    return {m_header->sectionViewportPosition(index.column()), y, m_header->sectionSize(index.column()),
            rowHeight()};
}

bool PacketView::isShown(const QModelIndex& index) const {
    return index.isValid() && index.row() >= topRow() && index.row() < topRow() + wholeRows();
}

void PacketView::scrollTo(const QModelIndex& index, ScrollHint hint) {
    if (!index.isValid()) {
        return;
    }
    const int row = index.row();
    if (isShown(index) && hint == EnsureVisible) {
        return;
    }
    // A row next to the shown ones scrolls by little; one from elsewhere is shown among its neighbours.
    const bool isNear = row >= topRow() - wholeRows() && row < topRow() + 2 * wholeRows();
    int top = row - wholeRows() / 2;
    if (hint == PositionAtTop || (isNear && row < topRow())) {
        top = row;
    } else if (hint == PositionAtBottom || isNear) {
        top = row - wholeRows() + 1;
    }
    verticalScrollBar()->setValue(top);
}

QModelIndex PacketView::indexAt(const QPoint& point) const {
    if (model() == nullptr || point.y() < 0) {
        return {};
    }
    const int column = m_header->logicalIndexAt(point.x());
    return model()->index(topRow() + point.y() / rowHeight(), std::max(0, column));
}

bool PacketView::event(QEvent* event) {
    // End alone is the window's everywhere: back to live.
    if (event->type() == QEvent::ShortcutOverride &&
        (wantsNewest(*static_cast<QKeyEvent*>(event)) ||
         static_cast<QKeyEvent*>(event)->matches(QKeySequence::Copy))) {
        event->accept();
        return true;
    }
    return QAbstractItemView::event(event);
}

void PacketView::keyPressEvent(QKeyEvent* event) {
    if (event->matches(QKeySequence::Copy)) {
        emit copyRequested();
        event->accept();
    } else if (wantsNewest(*event)) {
        emit newestRequested();
        event->accept();
    } else {
        QAbstractItemView::keyPressEvent(event);
    }
}

/// By keyboard the menu belongs to the current row, not to where the pointer happens to be.
void PacketView::contextMenuEvent(QContextMenuEvent* event) {
    if (event->reason() != QContextMenuEvent::Keyboard) {
        emit menuRequested(event->globalPos());
        return;
    }
    scrollTo(currentIndex());
    const QRect cell = visualRect(currentIndex());
    const int x = std::clamp(cell.left(), 0, std::max(0, viewport()->width() - rowHeight()));
    emit menuRequested(viewport()->mapToGlobal(cell.isNull() ? QPoint(0, 0) : QPoint(x, cell.bottom())));
}

QModelIndex PacketView::moveCursor(CursorAction action, Qt::KeyboardModifiers /*modifiers*/) {
    const int rows = model() == nullptr ? 0 : model()->rowCount();
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

int PacketView::horizontalOffset() const {
    return m_header->offset();
}

void PacketView::setSelection(const QRect& rect, QItemSelectionModel::SelectionFlags flags) {
    const int rows = model() == nullptr ? 0 : model()->rowCount();
    if (rows == 0) {
        return;
    }
    const auto rowAt = [&](int y) {
        return std::clamp(topRow() + (y < 0 ? -1 : y / rowHeight()), 0, rows - 1);
    };
    const bool isBelow = rect.top() / rowHeight() + topRow() >= rows;
    if (isBelow) {
        selectionModel()->select(QItemSelection(), flags);
        return;
    }
    selectionModel()->select(QItemSelection(model()->index(rowAt(rect.top()), 0),
                                            model()->index(rowAt(rect.bottom()), model()->columnCount() - 1)),
                             flags);
}

QRegion PacketView::visualRegionForSelection(const QItemSelection& selection) const {
    QRegion region;
    for (const QItemSelectionRange& range : selection) {
        const int first = std::max(range.top(), topRow());
        const int last = std::min(range.bottom(), topRow() + wholeRows());
        if (first <= last) {
            region += QRect(0, (first - topRow()) * rowHeight(), viewport()->width(),
                            (last - first + 1) * rowHeight());
        }
    }
    return region;
}

void PacketView::scrollContentsBy(int dx, int /*dy*/) {
    if (dx != 0) {
        m_header->setOffset(horizontalScrollBar()->value());
    }
    viewport()->update();
}

void PacketView::resizeEvent(QResizeEvent* event) {
    QAbstractItemView::resizeEvent(event);
    m_header->fit();
    updateGeometries();
}

void PacketView::changeEvent(QEvent* event) {
    QAbstractItemView::changeEvent(event);
    if (event->type() == QEvent::FontChange || event->type() == QEvent::StyleChange) {
        m_header->fit();
        updateGeometries();
    }
}

} // namespace posewire::gui
