// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/byte_view.h"

#include "app/gui/panels/cell_delegate.h"
#include "app/gui/theme/theme.h"

#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QPainter>
#include <QScrollBar>

#include <algorithm>
#include <array>

namespace posewire::gui {

namespace {

constexpr int kOffsetDigits = 4;
constexpr int kGroup = 8; ///< bytes between wider spaces

} // namespace

ByteView::ByteView(QWidget* parent) : QAbstractScrollArea(parent) {
    setFrameShape(QFrame::NoFrame);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setFocusPolicy(Qt::StrongFocus);
    viewport()->setMouseTracking(true);
    viewport()->setCursor(Qt::ArrowCursor);
    setAccessibleName(tr("Bytes of the packet"));
    fit();
}

void ByteView::setDocument(std::shared_ptr<const FieldDocument> document) {
    const bool isResized = document->bytes.size() != m_document->bytes.size();
    m_document = std::move(document);
    m_current = std::min(m_current, size() == 0 ? 0 : size() - 1);
    markBytes();
    if (isResized) {
        fit();
    }
    viewport()->update();
}

void ByteView::setOther(std::shared_ptr<const FieldDocument> other) {
    m_other = std::move(other);
    viewport()->update();
}

void ByteView::markBytes() {
    m_health.assign(size(), Health::Unknown);
    m_isUnread.assign(size(), false);
    for (const FieldProblem& problem : m_document->problems) {
        const std::uint32_t end = std::min(problem.offset + problem.length, size());
        for (std::uint32_t i = problem.offset; problem.level != Health::Unknown && i < end; ++i) {
            m_health[i] = m_health[i] == Health::Error ? Health::Error : problem.level;
        }
    }
    for (const wire::FieldNode& node : m_document->tree.nodes) {
        for (std::uint32_t i = node.offset;
             node.kind == wire::NodeKind::Unread && i < node.offset + node.length; ++i) {
            m_isUnread[i] = true;
        }
    }
}

void ByteView::setSelected(const ByteRange& range) {
    if (range == m_selected) {
        return;
    }
    m_selected = range;
    if (!range.contains(m_current)) {
        m_current = range.begin;
    }
    viewport()->update();
}

void ByteView::setHovered(const ByteRange& range) {
    if (range != m_hovered) {
        m_hovered = range;
        viewport()->update();
    }
}

void ByteView::scrollTo(std::uint32_t offset) {
    const int top = static_cast<int>(offset) / m_perRow * rowHeight();
    const int shown = verticalScrollBar()->value();
    const int height = viewport()->height() - rowHeight();
    if (top < shown || top > shown + height) {
        verticalScrollBar()->setValue(top - height / 3);
    }
}

/// The widest row that fits, the characters beside it first given up.
void ByteView::fit() {
    m_advance = QFontMetricsF(monospaceFont()).horizontalAdvance(QLatin1Char('0'));
    m_margin = CellDelegate::margin(fontMetrics());
    const double room = viewport()->width() - 2 * m_margin;
    const auto width = [&](int bytes) {
        const int groups = (bytes - 1) / kGroup;
        return m_advance * (kOffsetDigits + 2 + 3 * bytes + groups + bytes + 1);
    };
    m_perRow = kGroup;
    m_hasText = width(kGroup) <= room;
    for (const int bytes : {16, 32}) {
        m_perRow = width(bytes) <= room ? bytes : m_perRow;
    }
    const int rows = (static_cast<int>(size()) + m_perRow - 1) / m_perRow;
    verticalScrollBar()->setSingleStep(rowHeight());
    verticalScrollBar()->setPageStep(viewport()->height());
    verticalScrollBar()->setRange(0, std::max(0, rows * rowHeight() + 6 - viewport()->height()));
}

double ByteView::columnLeft(int column) const {
    const int gaps = column / kGroup;
    return m_margin + m_advance * (kOffsetDigits + 2 + 3 * column + gaps);
}

QRectF ByteView::hexCell(std::uint32_t offset) const {
    const int column = static_cast<int>(offset) % m_perRow;
    const int row = static_cast<int>(offset) / m_perRow;
    const double top = row * rowHeight() - verticalScrollBar()->value() + 3;
    return {columnLeft(column) - m_advance / 2, top, 3 * m_advance, static_cast<double>(rowHeight())};
}

QRectF ByteView::textCell(std::uint32_t offset) const {
    const QRectF hex = hexCell(offset);
    const int column = static_cast<int>(offset) % m_perRow;
    return {columnLeft(m_perRow) + m_advance * (column + 0.5), hex.top(), m_advance, hex.height()};
}

std::int64_t ByteView::byteAt(const QPoint& point) const {
    const double y = point.y() - 3 + verticalScrollBar()->value();
    if (y < 0) {
        return -1;
    }
    const auto row = static_cast<std::uint32_t>(y / rowHeight());
    for (std::uint32_t column = 0; column < static_cast<std::uint32_t>(m_perRow); ++column) {
        const std::uint32_t offset = row * static_cast<std::uint32_t>(m_perRow) + column;
        const bool isText = m_hasText && textCell(offset).contains(point);
        if (offset < size() && (isText || hexCell(offset).contains(point))) {
            return offset;
        }
    }
    return -1;
}

void ByteView::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(viewport());
    painter.fillRect(viewport()->rect(), theme().panel);
    painter.setFont(monospaceFont());
    const auto first = static_cast<std::uint32_t>(verticalScrollBar()->value() / rowHeight());
    const auto rows = static_cast<std::uint32_t>(viewport()->height() / rowHeight() + 2);
    for (std::uint32_t row = first; row < first + rows && row * static_cast<std::uint32_t>(m_perRow) < size();
         ++row) {
        paintRow(painter, row);
    }
}

void ByteView::paintRow(QPainter& painter, std::uint32_t row) {
    const std::uint32_t begin = row * static_cast<std::uint32_t>(m_perRow);
    const std::uint32_t end = std::min(begin + static_cast<std::uint32_t>(m_perRow), size());
    const QRectF line = hexCell(begin);
    painter.setPen(theme().dim);
    painter.drawText(QRectF(m_margin, line.top(), m_advance * (kOffsetDigits + 1), line.height()),
                     Qt::AlignVCenter | Qt::AlignLeft,
                     QString::number(begin, 16).rightJustified(kOffsetDigits, QLatin1Char('0')));
    for (std::uint32_t offset = begin; offset < end; ++offset) {
        paintByte(painter, offset);
    }
}

void ByteView::paintMarks(QPainter& painter, std::uint32_t offset, const QRectF& cell) const {
    const QRectF inner = cell.adjusted(0, 1, 0, -1);
    if (m_selected.contains(offset)) {
        painter.fillRect(inner, theme().selection);
    }
    if (m_hovered.contains(offset)) {
        painter.fillRect(inner, withAlpha(theme().accent, 0.22));
    }
    const Health health = m_health[offset];
    if (health == Health::Unknown) {
        return;
    }
    painter.setPen(QPen(healthColour(health), 1.6));
    painter.drawLine(inner.bottomLeft(), inner.bottomRight());
    if (health == Health::Error && !m_isUnread[offset]) {
        painter.fillRect(inner, withAlpha(healthColour(health), 0.18));
        painter.drawLine(inner.topLeft(), inner.topRight());
    }
}

void ByteView::paintByte(QPainter& painter, std::uint32_t offset) {
    const std::byte byte = m_document->bytes[offset];
    const unsigned value = std::to_integer<unsigned>(byte);
    const bool isDifferent =
        m_other != nullptr && (offset >= m_other->bytes.size() || m_other->bytes[offset] != byte);
    const Health health = m_health[offset];
    const QColor colour = health != Health::Unknown && !m_isUnread[offset] ? healthColour(health)
                          : isDifferent                                    ? theme().warning
                          : m_isUnread[offset]                             ? theme().dim
                                                                           : theme().text;
    const QRectF cell = hexCell(offset);
    paintMarks(painter, offset, cell);
    painter.setPen(colour);
    painter.drawText(cell, Qt::AlignCenter, QString::number(value, 16).rightJustified(2, QLatin1Char('0')));
    if (m_hasText) {
        const QRectF text = textCell(offset);
        paintMarks(painter, offset, text);
        const bool isPrintable = value >= 0x20 && value < 0x7f;
        painter.setPen(isPrintable ? colour : theme().dim);
        painter.drawText(text, Qt::AlignCenter, isPrintable ? QString(QChar(value)) : QStringLiteral("·"));
    }
}

void ByteView::mousePressEvent(QMouseEvent* event) {
    const std::int64_t offset = byteAt(event->position().toPoint());
    if (offset >= 0) {
        m_current = static_cast<std::uint32_t>(offset);
        emit activated(m_current);
    }
}

void ByteView::keyPressEvent(QKeyEvent* event) {
    const std::int64_t page =
        std::max<std::int64_t>(1, viewport()->height() / rowHeight() - 1) * std::int64_t{m_perRow};
    const std::array<std::pair<int, std::int64_t>, 8> moves{{{Qt::Key_Left, -1},
                                                             {Qt::Key_Right, 1},
                                                             {Qt::Key_Up, -m_perRow},
                                                             {Qt::Key_Down, m_perRow},
                                                             {Qt::Key_PageUp, -page},
                                                             {Qt::Key_PageDown, page},
                                                             {Qt::Key_Home, -std::int64_t{m_current}},
                                                             {Qt::Key_End, size()}}};
    const auto move = std::ranges::find(moves, event->key(), &std::pair<int, std::int64_t>::first);
    if (move == moves.end() || size() == 0) {
        QAbstractScrollArea::keyPressEvent(event);
        return;
    }
    const std::int64_t wanted = std::int64_t{m_current} + move->second;
    m_current = static_cast<std::uint32_t>(std::clamp<std::int64_t>(wanted, 0, size() - 1));
    scrollTo(m_current);
    emit activated(m_current);
}

void ByteView::contextMenuEvent(QContextMenuEvent* event) {
    const bool isByKey = event->reason() == QContextMenuEvent::Keyboard;
    emit menuRequested(isByKey ? viewport()->mapToGlobal(centreOf(m_current)) : event->globalPos());
}

bool ByteView::viewportEvent(QEvent* event) {
    const bool isTaken = QAbstractScrollArea::viewportEvent(event);
    if (event->type() == QEvent::Leave) {
        emit hovered(-1);
    } else if (event->type() == QEvent::Resize || event->type() == QEvent::FontChange ||
               event->type() == QEvent::StyleChange) {
        fit();
    }
    return isTaken;
}

} // namespace posewire::gui
