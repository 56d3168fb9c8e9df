// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/table_view.h"

#include "app/gui/models/column.h"
#include "app/gui/panels/cell_delegate.h"
#include "app/gui/theme/balanced_text.h"
#include "app/gui/theme/theme.h"

#include <QContextMenuEvent>
#include <QHeaderView>
#include <QKeyEvent>
#include <QMenu>
#include <QPainter>

#include <algorithm>

namespace posewire::gui {

void drawEmptyText(QWidget& view, const QString& text) {
    QPainter painter(&view);
    painter.setPen(theme().dim);
    const int space = 2 * CellDelegate::margin(view.fontMetrics());
    drawBalanced(painter, view.rect().adjusted(space, space, -space, -space), text);
}

TableView::TableView(const QString& name, QWidget* parent) : QTreeView(parent) {
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
    header()->setStretchLastSection(false);
    header()->setSectionsMovable(false);
    header()->setMinimumSectionSize(0);
    header()->setHighlightSections(false);
    setCornerWidget(new QWidget(this)); // else the style draws a box between the scroll bars
    header()->setTextElideMode(Qt::ElideRight);
}

void TableView::setColumnSamples(std::vector<QString> samples, const QString& leastOpen) {
    m_samples = std::move(samples);
    m_leastOpen = leastOpen.isEmpty() ? QStringLiteral("12345678") : leastOpen;
    fitColumns();
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
        setAccessibleDescription(text);
        viewport()->update();
    }
}

int TableView::textWidth(const QString& text) const {
    // Some room beyond the text, since hinting may draw it wider than it was measured.
    const int margins = 2 * CellDelegate::margin(fontMetrics()) + 5;
    return QFontMetrics(tabularFont()).horizontalAdvance(text) + margins;
}

int TableView::sampleWidth(int column) const {
    const QString title = model()->headerData(column, Qt::Horizontal, Qt::DisplayRole).toString();
    // The style sheet pads header sections by 6 pixels at either side.
    const int headerWidth = isHeaderHidden() ? 0 : fontMetrics().horizontalAdvance(title) + 14;
    return std::max(textWidth(m_samples[static_cast<std::size_t>(column)]), headerWidth);
}

void TableView::fitColumns() {
    if (model() == nullptr || m_samples.empty()) {
        return;
    }
    setIndentation(fontMetrics().height() * 4 / 5);
    for (int column = 0; column < static_cast<int>(m_samples.size()); ++column) {
        if (!m_samples[static_cast<std::size_t>(column)].isEmpty() && !isColumnHidden(column)) {
            header()->resizeSection(column, sampleWidth(column));
        }
    }
    fitOpenColumn();
}

void TableView::fitOpenColumn() {
    const auto open = std::ranges::find(m_samples, QString());
    if (model() == nullptr || open == m_samples.end()) {
        return;
    }
    const int column = static_cast<int>(open - m_samples.begin());
    leaveOutWhatDoesNotFit(column);
    const int others = header()->length() - header()->sectionSize(column);
    header()->resizeSection(column, std::max(textWidth(m_leastOpen), viewport()->width() - others));
}

void TableView::leaveOutWhatDoesNotFit(int open) {
    if (m_firstOptional < 0 || m_isChosen) {
        return;
    }
    int width = textWidth(m_leastOpen);
    for (int column = 0; column < static_cast<int>(m_samples.size()); ++column) {
        width += column == open ? 0 : sampleWidth(column);
        if (column >= m_firstOptional && column != open) {
            setColumnHidden(column, width > viewport()->width());
        }
    }
}

void TableView::setOptionalColumns(int first) {
    m_firstOptional = first;
    header()->setContextMenuPolicy(Qt::CustomContextMenu);
    connect(header(), &QWidget::customContextMenuRequested, this, &TableView::showHeaderMenu);
    fitColumns();
}

QJsonArray TableView::chosenColumns() const {
    QJsonArray columns;
    for (int column = 0; m_isChosen && column < static_cast<int>(m_samples.size()); ++column) {
        if (!isColumnHidden(column)) {
            columns.append(column);
        }
    }
    return columns;
}

void TableView::setChosenColumns(const QJsonArray& columns) {
    m_isChosen = !columns.isEmpty();
    for (int column = 1; m_isChosen && column < static_cast<int>(m_samples.size()); ++column) {
        setColumnHidden(column, !columns.contains(column));
    }
    fitColumns();
}

void TableView::showHeaderMenu(const QPoint& at) {
    QMenu menu(this);
    addColumnActions(menu);
    menu.exec(header()->mapToGlobal(at));
}

void TableView::addColumnActions(QMenu& menu) {
    QAction* fitting = menu.addAction(tr("As many columns as fit"));
    fitting->setCheckable(true);
    fitting->setChecked(!m_isChosen);
    connect(fitting, &QAction::triggered, this, [this] { setChosenColumns({}); });
    menu.addSeparator();
    for (int column = 1; column < static_cast<int>(m_samples.size()); ++column) {
        QAction* action = menu.addAction(model()->headerData(column, Qt::Horizontal).toString());
        action->setToolTip(model()->headerData(column, Qt::Horizontal, Qt::ToolTipRole).toString());
        action->setCheckable(true);
        action->setChecked(!isColumnHidden(column));
        connect(action, &QAction::toggled, this,
                [this, column](bool isShown) { chooseColumn(column, isShown); });
    }
    menu.setToolTipsVisible(true);
}

void TableView::chooseColumn(int column, bool isShown) {
    QJsonArray columns{0};
    for (int each = 1; each < static_cast<int>(m_samples.size()); ++each) {
        if (each == column ? isShown : !isColumnHidden(each)) {
            columns.append(each);
        }
    }
    setChosenColumns(columns);
}

int TableView::heightForRows(int rows) const {
    const int row = CellDelegate::rowHeight(fontMetrics());
    return row * (rows + (isHeaderHidden() ? 0 : 1)) + 2;
}

void TableView::dataChanged(const QModelIndex& topLeft, const QModelIndex& bottomRight,
                            const QList<int>& roles) {
    QTreeView::dataChanged(topLeft, bottomRight, roles);
    viewport()->update();
}

void TableView::paintEvent(QPaintEvent* event) {
    QTreeView::paintEvent(event);
    if (m_emptyText.isEmpty() || model() == nullptr || model()->rowCount() != 0) {
        return;
    }
    drawEmptyText(*viewport(), m_emptyText);
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

void TableView::contextMenuEvent(QContextMenuEvent* event) {
    const bool isByKey = event->reason() == QContextMenuEvent::Keyboard;
    const QModelIndex index = isByKey ? currentIndex() : indexAt(event->pos());
    QMenu menu(this);
    emit menuRequested(menu, index);
    const auto add = [this, &menu](const QString& title, const QString& text) {
        connect(menu.addAction(title), &QAction::triggered, this, [this, text] { emit copyRequested(text); });
        menu.actions().back()->setEnabled(!text.isEmpty());
    };
    add(tr("Copy cell"), index.isValid() ? cellText(index) : QString());
    add(tr("Copy row"), index.isValid() ? rowText(index) : QString());
    add(tr("Copy all as text"), allText());
    if (m_firstOptional >= 0) {
        menu.addSeparator();
        addColumnActions(*menu.addMenu(tr("Columns")));
    }
    menu.exec(isByKey ? viewport()->mapToGlobal(visualRect(index).center()) : event->globalPos());
}

void TableView::keyPressEvent(QKeyEvent* event) {
    if (event->matches(QKeySequence::Copy)) {
        if (currentIndex().isValid()) {
            emit copyRequested(rowText(currentIndex()));
        }
        event->accept();
        return;
    }
    QTreeView::keyPressEvent(event);
}

void TableView::changeEvent(QEvent* event) {
    QTreeView::changeEvent(event);
    if (event->type() == QEvent::FontChange || event->type() == QEvent::StyleChange) {
        fitColumns();
    }
}

void TableView::resizeEvent(QResizeEvent* event) {
    QTreeView::resizeEvent(event);
    fitOpenColumn();
}

} // namespace posewire::gui
