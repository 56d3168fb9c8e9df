// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/table_view.h"

#include "app/gui/base/saving.h"
#include "app/gui/models/column.h"
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/theme/event_watch.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"

#include <QContextMenuEvent>
#include <QDrag>
#include <QKeyEvent>
#include <QMenu>
#include <QPainter>

namespace posewire::gui {

void drawEmptyText(QWidget& view, const QString& text) {
    QPainter painter(&view);
    painter.setPen(theme().dim);
    const int space = 2 * CellDelegate::margin(view.fontMetrics());
    const QRectF room = view.rect().adjusted(space, 0, -space, 0);
    const QString fitting = fittingLines(painter.fontMetrics(), text, room.size());
    const qreal unused = room.width() - balancedWidth(painter.fontMetrics(), fitting, room.width());
    painter.drawText(room.adjusted(unused / 2, 0, -unused / 2, 0), Qt::AlignCenter | Qt::TextWordWrap,
                     fitting);
}

QString fittingLines(const QFontMetrics& metrics, const QString& text, const QSizeF& room) {
    const auto isFitting = [&](const QString& part) {
        const QRectF wide(0, 0, room.width(), 1e6);
        return metrics.boundingRect(wide.toRect(), Qt::AlignCenter | Qt::TextWordWrap, part).height() <=
               room.height();
    };
    QString fitting = text.trimmed();
    while (!isFitting(fitting) && fitting.contains(QLatin1Char('\n'))) {
        fitting.truncate(fitting.lastIndexOf(QLatin1Char('\n')));
    }
    return isFitting(fitting) ? (fitting == text.trimmed() ? text : fitting)
                              : metrics.elidedText(fitting, Qt::ElideRight, static_cast<int>(room.width()));
}

TableView::TableView(const QString& name, QWidget* parent)
    // Some room beyond the text, since hinting may draw it wider than it was measured.
    : QTreeView(parent), m_columns(new FittingHeader(this, tabularFont, 5, FittingHeader::Kept::First)) {
    setAccessibleName(name);
    setItemDelegate(new CellDelegate(this));
    setUniformRowHeights(true);
    setAlternatingRowColors(true);
    setFrameShape(QFrame::NoFrame);
    setRootIsDecorated(false);
    setAllColumnsShowFocus(true);
    setSelectionMode(QAbstractItemView::SingleSelection);
    setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
    setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    setTabKeyNavigation(false);
    setExpandsOnDoubleClick(false);
    setHeader(m_columns);
    const auto indent = [this] { setIndentation(fontMetrics().height() * 4 / 5); };
    indent();
    new EventWatch(this, QEvent::FontChange, indent);
    new EventWatch(this, QEvent::StyleChange, indent);
    setCornerWidget(new QWidget(this)); // else the style draws a box between the scroll bars
}

void TableView::expandNew() {
    connect(model(), &QAbstractItemModel::rowsInserted, this,
            [this](const QModelIndex& parent, int first, int last) {
                for (int row = first; row <= last && !parent.parent().isValid(); ++row) {
                    expandRecursively(model()->index(row, 0, parent));
                }
            });
}

void TableView::setEmptyText(const QString& text) {
    if (text != m_emptyText) {
        m_emptyText = text;
        describe();
        viewport()->update();
    }
}

void TableView::setModel(QAbstractItemModel* model) {
    QTreeView::setModel(model);
    if (model != nullptr) {
        connect(model, &QAbstractItemModel::rowsRemoved, this, &TableView::describe);
        connect(model, &QAbstractItemModel::rowsInserted, this, &TableView::describe);
        connect(model, &QAbstractItemModel::modelReset, this, &TableView::describe);
        describe();
    }
}

/// Only while it is empty it is said what to do.
void TableView::describe() {
    const bool isEmpty = model() == nullptr || model()->rowCount() == 0;
    const QString text = isEmpty ? m_emptyText : QString();
    if (text != accessibleDescription()) {
        setAccessibleDescription(text);
    }
}

void TableView::showFacts(QAbstractItemModel& facts) {
    setHeaderHidden(true);
    setModel(&facts);
}

void TableView::fixHeight() {
    setFixedHeight(heightForRows(model()->rowCount()));
    setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
}

void TableView::setDragged(std::function<QMimeData*(const QModelIndex& index)> dragged) {
    m_dragged = std::move(dragged);
    setDragEnabled(true);
}

void TableView::startDrag(Qt::DropActions /*of the model*/) {
    QMimeData* content = m_dragged && currentIndex().isValid() ? m_dragged(currentIndex()) : nullptr;
    if (content != nullptr) {
        auto* drag = new QDrag(this); // goes by itself
        drag->setMimeData(content);
        drag->exec(Qt::CopyAction);
    }
}

int TableView::heightForRows(int rows) const {
    const int row = CellDelegate::rowHeight(fontMetrics());
    return row * (rows + (isHeaderHidden() ? 0 : 1)) + 2;
}

void TableView::dataChanged(const QModelIndex& topLeft, const QModelIndex& bottomRight,
                            const QList<int>& roles) {
    if (topLeft == bottomRight) {
        QTreeView::dataChanged(topLeft, bottomRight, roles);
    }
    m_columns->keepWhole();
    viewport()->update(static_cast<CellDelegate*>(itemDelegate())->takeStale(*this));
}

void TableView::paintEvent(QPaintEvent* event) {
    QTreeView::paintEvent(event);
    if (model() != nullptr && model()->rowCount() == 0) {
        drawEmptyText(*viewport(), m_emptyText);
    }
}

QString TableView::rowText(const QModelIndex& index) const {
    QStringList cells;
    for (int column = 0; column < model()->columnCount(index.parent()); ++column) {
        cells += cellText(index.siblingAtColumn(column));
    }
    return cells.join(QLatin1Char('\t'));
}

void TableView::addRows(QString& text, const QModelIndex& parent) const {
    for (int row = 0; row < model()->rowCount(parent); ++row) {
        const QModelIndex index = model()->index(row, 0, parent);
        text += rowText(index) + QLatin1Char('\n');
        addRows(text, index);
    }
}

QString TableView::allText() const {
    QStringList titles;
    for (int column = 0; column < model()->columnCount(); ++column) {
        titles += model()->headerData(column, Qt::Horizontal).toString();
    }
    QString text = titles.join(QLatin1Char('\t')) + QLatin1Char('\n');
    addRows(text, {});
    return text;
}

/// Texts are made once they are wanted: all of a table may be much.
void TableView::addCopying(QMenu& menu, const QModelIndex& index) {
    const QPersistentModelIndex kept(index);
    QAction* cell = menu.addAction(tr("Copy cell"), this, [this, kept] { copy(cellText(kept)); });
    QAction* row = menu.addAction(tr("Copy row"), this,
                                  [this, kept] { copy(kept.isValid() ? rowText(kept) : QString()); });
    cell->setEnabled(index.isValid() && !cellText(index).isEmpty());
    row->setEnabled(index.isValid());
    menu.addAction(tr("Copy all as text"), this, [this] { copy(allText()); });
}

/// A row may be gone by the time that it is asked for.
void TableView::copy(const QString& text) {
    if (!text.isEmpty()) {
        copyText(text);
    }
}

void TableView::contextMenuEvent(QContextMenuEvent* event) {
    const bool isByKey = event->reason() == QContextMenuEvent::Keyboard;
    const QModelIndex index = isByKey ? currentIndex() : indexAt(event->pos());
    QMenu menu(this);
    emit menuRequested(menu, index);
    addCopying(menu, index);
    if (m_columns->isChoosable()) {
        menu.addSeparator();
        m_columns->addColumnActions(*menu.addMenu(tr("Columns")));
    }
    menu.exec(isByKey ? viewport()->mapToGlobal(visualRect(index).center()) : event->globalPos());
}

void TableView::keyPressEvent(QKeyEvent* event) {
    if (event->matches(QKeySequence::Copy)) {
        if (currentIndex().isValid()) {
            copyText(rowText(currentIndex()));
        }
        event->accept();
        return;
    }
    QTreeView::keyPressEvent(event);
}

} // namespace posewire::gui
