// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/field_view.h"

#include "app/gui/base/saving.h"
#include "app/gui/models/curve_text.h"
#include "app/gui/models/display_filter.h"
#include "app/gui/models/field_text.h"
#include "app/gui/theme/theme.h"
#include "core/filter/completion.h"
#include "core/wire/text.h"

#include <QContextMenuEvent>
#include <QMenu>
#include <QPainter>
#include <QScrollBar>

namespace posewire::gui {

namespace {

/// "0x4d, 0x58": each byte after `prefix`.
QString bytesText(wire::Bytes bytes, const QString& prefix, const QString& separator) {
    QStringList texts;
    for (const std::byte byte : bytes) {
        texts += prefix + QString::fromStdString(wire::hexadecimal({&byte, 1}));
    }
    return texts.join(separator);
}

} // namespace

FieldView::FieldView(FieldModel& model, Commands& commands, QWidget* parent)
    : TableView(tr("Fields of the packet"), parent), m_fields(model), m_commands(commands) {
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
    setDragged([this](const QModelIndex& index) -> QMimeData* {
        const QStringList curves = curvesOf(m_fields.document(), m_fields.node(index));
        return curves.isEmpty() ? nullptr : asDragged(curves);
    });
    columns().setContextMenuPolicy(Qt::NoContextMenu); // its columns follow from the packets
}

std::int32_t FieldView::currentNode() const {
    const QModelIndex current = currentIndex();
    return current.isValid()       ? m_fields.node(current)
           : m_currentPath.empty() ? -1
                                   : m_fields.document().find(m_currentPath);
}

void FieldView::change(const std::function<void()>& carryOut) {
    m_isChanging = true;
    m_wasReset = false;
    const int scrolled = verticalScrollBar()->value();
    carryOut();
    if (m_wasReset) {
        restore({});
        if (const QModelIndex current = m_fields.indexOf(m_fields.document().find(m_currentPath));
            current.isValid() && !m_currentPath.empty()) {
            selectionModel()->setCurrentIndex(current, QItemSelectionModel::ClearAndSelect |
                                                           QItemSelectionModel::Rows);
        }
        doItemsLayout();
        verticalScrollBar()->setValue(scrolled);
    }
    m_isChanging = false;
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

void FieldView::openFirst() {
    for (int row = 0; row < m_fields.rowCount(); ++row) {
        const QModelIndex index = m_fields.index(row, 0);
        const bool isHeader = m_fields.document().node(m_fields.node(index)).name == "header";
        setExpanded(index, !isHeader || m_fields.rowCount() == 1);
    }
}

void FieldView::setCurrentNode(std::int32_t node) {
    if (node < 0) {
        return;
    }
    m_currentPath = m_fields.document().tree.path(node);
    const QModelIndex index = m_fields.indexOf(node);
    for (QModelIndex around = index.parent(); around.isValid(); around = around.parent()) {
        expand(around);
    }
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
    showMenu(isByKey ? viewport()->mapToGlobal(visualRect(currentIndex()).center()) : event->globalPos());
}

bool FieldView::viewportEvent(QEvent* event) {
    if (event->type() == QEvent::Leave) {
        emit nodeEntered(-1);
    }
    return TableView::viewportEvent(event);
}

void FieldView::showMenu(const QPoint& at) {
    const std::int32_t node = currentNode();
    if (node < 0) {
        return;
    }
    QMenu menu(this);
    addFilters(menu);
    const QStringList curves = curvesOf(m_fields.document(), node);
    menu.addAction(tr("Plot"), this, [this, curves] { m_commands.plot(curves); })
        ->setEnabled(!curves.isEmpty());
    menu.addSeparator();
    const auto addCopy = [&](const QString& text, const QString& copied) {
        menu.addAction(text, this, [copied] { copyText(copied); })->setEnabled(!copied.isEmpty());
    };
    const FieldDocument& document = m_fields.document();
    const wire::FieldNode& field = document.node(node);
    const wire::Bytes bytes = wire::Bytes(document.bytes).subspan(field.offset, field.length);
    addCopy(tr("Copy value"), convertedValue(document, node));
    addCopy(tr("Copy value on the wire"), QString::fromStdString(field.value));
    addCopy(tr("Copy field path"), QString::fromStdString(document.tree.path(node)));
    addCopy(tr("Copy bytes as hexadecimal"), bytesText(bytes, QString(), QStringLiteral(" ")));
    addCopy(tr("Copy bytes as C array"),
            QStringLiteral("{%1}").arg(bytesText(bytes, QStringLiteral("0x"), QStringLiteral(", "))));
    menu.exec(at);
}

void FieldView::addFilters(QMenu& menu) {
    const QString displayFilter = QString::fromStdString(m_commands.session().choices().displayFilter);
    const QString expression =
        QString::fromStdString(filter::expressionFor(m_fields.document().tree, currentNode()));
    QMenu* filters = menu.addMenu(tr("Apply as filter"));
    filters->setEnabled(!expression.isEmpty());
    constexpr qsizetype kMostToolTip = 500;
    const auto add = [&](const QString& text, const QString& joined) {
        filters->addAction(menuText(text), this, [this, joined] { m_commands.setDisplayFilter(joined); })
            ->setToolTip(toolTipText(joined.left(kMostToolTip)));
    };
    filters->setToolTipsVisible(true);
    add(expression, expression);
    add(tr("Not this"), joinedFilter({}, expression, FilterJoin::AndNot));
    add(tr("… and this"), joinedFilter(displayFilter, expression, FilterJoin::And));
    add(tr("… or this"), joinedFilter(displayFilter, expression, FilterJoin::Or));
    add(tr("… and not this"), joinedFilter(displayFilter, expression, FilterJoin::AndNot));
}

} // namespace posewire::gui
