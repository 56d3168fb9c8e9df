// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/field_view.h"

#include "app/gui/models/display_filter.h"
#include "app/gui/models/field_text.h"
#include "app/gui/models/packet_text.h"
#include "app/gui/theme/theme.h"
#include "core/filter/completion.h"

#include <QContextMenuEvent>
#include <QMenu>
#include <QPainter>
#include <QScrollBar>

namespace posewire::gui {

namespace {

QString bytesText(const FieldMenu& menu, const QString& prefix, const QString& separator) {
    const wire::FieldNode& field = menu.document.node(menu.node);
    QStringList bytes;
    for (std::uint32_t i = field.offset; i < field.offset + field.length; ++i) {
        const auto value = std::to_integer<unsigned>(menu.document.bytes()[i]);
        bytes += prefix + QString::number(value, 16).rightJustified(2, QLatin1Char('0'));
    }
    return bytes.join(separator);
}

void addFilters(QMenu& menu, const FieldMenu& field) {
    const QString expression =
        QString::fromStdString(filter::expressionFor(field.document.tree(), field.node));
    const QString current = QString::fromStdString(field.displayFilter);
    QMenu* filters = menu.addMenu(FieldView::tr("Apply as filter"));
    filters->setEnabled(!expression.isEmpty());
    const auto add = [&](const QString& text, const QString& joined) {
        Commands* commands = &field.commands;
        QAction* action =
            filters->addAction(text, filters, [commands, joined] { commands->setDisplayFilter(joined); });
        action->setToolTip(joined);
    };
    filters->setToolTipsVisible(true);
    add(expression, expression);
    add(FieldView::tr("Not this"), joinedFilter({}, expression, FilterJoin::AndNot));
    add(FieldView::tr("… and this"), joinedFilter(current, expression, FilterJoin::And));
    add(FieldView::tr("… or this"), joinedFilter(current, expression, FilterJoin::Or));
    add(FieldView::tr("… and not this"), joinedFilter(current, expression, FilterJoin::AndNot));
}

} // namespace

FieldView::FieldView(FieldModel& model, Commands& commands, QWidget* parent)
    : TableView(tr("Fields of the packet"), commands, parent), m_fields(model) {
    setModel(&model);
    setRootIsDecorated(true);
    setExpandsOnDoubleClick(true);
    setMouseTracking(true);
    connect(this, &QTreeView::expanded, this, [this](const QModelIndex& index) {
        if (!m_isChanging) {
            m_open.insert(pathOf(index));
        }
    });
    connect(this, &QTreeView::collapsed, this, [this](const QModelIndex& index) {
        if (!m_isChanging) {
            m_open.erase(pathOf(index));
        }
    });
    connect(this, &QAbstractItemView::entered, this,
            [this](const QModelIndex& index) { emit nodeEntered(m_fields.node(index)); });
    connect(selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            [this](const QModelIndex& index) {
                if (!m_isChanging && index.isValid()) {
                    m_currentPath = pathOf(index);
                    emit nodeSelected(m_fields.node(index));
                }
            });
    connect(&model, &QAbstractItemModel::modelReset, this, [this] {
        m_wasReset = true;
        m_hovered = {};
    });
    fitToWidth();
}

std::int32_t FieldView::currentNode() const {
    const QModelIndex current = currentIndex();
    return current.isValid()       ? m_fields.node(current)
           : m_currentPath.empty() ? -1
                                   : m_fields.document().find(m_currentPath);
}

void FieldView::beginChange() {
    m_isChanging = true;
    m_wasReset = false;
    m_scrolled = verticalScrollBar()->value();
}

void FieldView::restore(const QModelIndex& parent) {
    for (int row = 0; row < m_fields.rowCount(parent); ++row) {
        const QModelIndex index = m_fields.index(row, 0, parent);
        if (m_fields.rowCount(index) > 0 && m_open.contains(pathOf(index))) {
            expand(index);
            restore(index);
        }
    }
}

void FieldView::endChange() {
    if (m_wasReset) {
        restore({});
        if (const QModelIndex current = m_fields.indexOf(m_fields.document().find(m_currentPath));
            current.isValid() && !m_currentPath.empty()) {
            selectionModel()->setCurrentIndex(current, QItemSelectionModel::ClearAndSelect |
                                                           QItemSelectionModel::Rows);
        }
        doItemsLayout();
        verticalScrollBar()->setValue(m_scrolled);
        fitToWidth();
    }
    m_isChanging = false;
}

void FieldView::openFirst() {
    for (int row = 0; row < m_fields.rowCount(); ++row) {
        const QModelIndex index = m_fields.index(row, 0);
        const bool isHeader = m_fields.document().node(m_fields.node(index)).name == "header";
        setExpanded(index, !isHeader || m_fields.rowCount() == 1);
    }
}

void FieldView::openTo(std::int32_t node) {
    for (QModelIndex index = m_fields.indexOf(node).parent(); index.isValid(); index = index.parent()) {
        expand(index);
    }
}

void FieldView::setCurrentNode(std::int32_t node) {
    if (node < 0) {
        return;
    }
    m_currentPath = m_fields.document().tree().path(node);
    const QModelIndex index = m_fields.indexOf(node);
    openTo(node);
    m_isChanging = true;
    selectionModel()->setCurrentIndex(index, QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
    m_isChanging = false;
    scrollTo(index, QAbstractItemView::EnsureVisible);
}

void FieldView::setHovered(std::int32_t node) {
    QModelIndex index = m_fields.indexOf(node);
    for (QModelIndex around = index.parent(); around.isValid(); around = around.parent()) {
        if (!isExpanded(around)) {
            index = around;
        }
    }
    if (index != m_hovered) {
        m_hovered = index;
        viewport()->update();
    }
}

void FieldView::drawRow(QPainter* painter, const QStyleOptionViewItem& option,
                        const QModelIndex& index) const {
    QTreeView::drawRow(painter, option, index);
    if (m_hovered.isValid() && index.siblingAtColumn(0) == m_hovered) {
        painter->fillRect(option.rect, withAlpha(theme().accent, 0.16));
    }
}

void FieldView::contextMenuEvent(QContextMenuEvent* event) {
    const bool isByKey = event->reason() == QContextMenuEvent::Keyboard;
    if (!isByKey && indexAt(event->pos()).isValid()) {
        setCurrentIndex(indexAt(event->pos()));
    }
    emit menuRequested(isByKey ? viewport()->mapToGlobal(visualRect(currentIndex()).center())
                               : event->globalPos());
}

bool FieldView::viewportEvent(QEvent* event) {
    if (event->type() == QEvent::Leave) {
        emit nodeEntered(-1);
    }
    return TableView::viewportEvent(event);
}

void FieldView::resizeEvent(QResizeEvent* event) {
    TableView::resizeEvent(event);
    fitToWidth();
}

/// A narrow tree shows fields and what they mean to say; a wide one all there is.
void FieldView::fitToWidth() {
    const int character = std::max(1, fontMetrics().averageCharWidth());
    const int width = viewport()->width() / character;
    const bool isComparing = m_fields.other() != nullptr;
    const bool isNarrow = width < 52;
    const int form =
        (width >= 96 ? 1 : 0) + (width >= 120 ? 2 : 0) + (isComparing ? 4 : 0) + (isNarrow ? 8 : 0);
    if (form == m_form) {
        return;
    }
    m_form = form;
    const bool hasMeaning = width >= 120;
    columns().setUseful(FieldModel::kWire, !isComparing && width >= 96);
    columns().setUseful(FieldModel::kOther, isComparing);
    columns().setUseful(FieldModel::kDifference, isComparing);
    columns().setUseful(FieldModel::kMeaning, hasMeaning);
    columns().setUseful(FieldModel::kSection, hasMeaning);
    // Where there is no room for a vector, its components below it can still be read.
    const QString vector =
        isNarrow ? QStringLiteral("23 × 736 bytes") : QStringLiteral("−0.000  −0.000  −0.000 m");
    std::vector<QString> samples(FieldModel::kColumnCount);
    const QString field = QStringLiteral("Segment 10 · RightUpperArmxx");
    samples[FieldModel::kField] = hasMeaning ? field : QString();
    samples[FieldModel::kValue] = isComparing ? QStringLiteral("−0.00  −0.00 m") : vector;
    samples[FieldModel::kWire] = width >= 120 ? QStringLiteral("-0.00000001  -0.00000001  -0.00000001 m")
                                              : QStringLiteral("-0.00000001  -0.0000");
    samples[FieldModel::kOther] = samples[FieldModel::kValue];
    samples[FieldModel::kDifference] = QStringLiteral("−0.0000 m");
    samples[FieldModel::kMeaning] = hasMeaning ? QString() : QStringLiteral("x");
    samples[FieldModel::kSection] = QStringLiteral("§ N 2.5.10");
    setColumnSamples(std::move(samples));
}

void showFieldMenu(const FieldMenu& field, QWidget* parent, const QPoint& at) {
    QMenu menu(parent);
    addFilters(menu, field);
    menu.addSeparator();
    const auto addCopy = [&](const QString& text, const QString& copied) {
        Commands* commands = &field.commands;
        menu.addAction(text, &menu, [commands, copied] { commands->copyText(copied); })
            ->setEnabled(!copied.isEmpty());
    };
    addCopy(FieldView::tr("Copy value"), convertedValue(field.document, field.node));
    addCopy(FieldView::tr("Copy value on the wire"),
            QString::fromStdString(field.document.node(field.node).value));
    addCopy(FieldView::tr("Copy field path"), QString::fromStdString(field.document.tree().path(field.node)));
    addCopy(FieldView::tr("Copy bytes as hexadecimal"), bytesText(field, QString(), QStringLiteral(" ")));
    addCopy(FieldView::tr("Copy bytes as C array"),
            QStringLiteral("{%1}").arg(bytesText(field, QStringLiteral("0x"), QStringLiteral(", "))));
    menu.exec(at);
}

} // namespace posewire::gui
