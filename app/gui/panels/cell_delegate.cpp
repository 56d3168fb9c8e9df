// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/panels/cell_delegate.h"

#include "app/gui/models/column.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/widgets.h"

#include <QApplication>
#include <QHeaderView>
#include <QPainter>
#include <QPainterPath>
#include <QTreeView>

#include <algorithm>
#include <array>
#include <cmath>

namespace posewire::gui {

namespace {

/// A steady rate is a flat line, not its noise blown up.
constexpr float kLeastSpread = 0.2F;
/// Values of a curve that fill its cell.
constexpr double kPlaces = 120;

bool isEmpty(const QModelIndex& index) {
    constexpr std::array kRoles{kSeriesRole, kSwatchRole, kDotRole, int{Qt::CheckStateRole}};
    return index.data().toString().isEmpty() &&
           std::ranges::none_of(kRoles, [&](int role) { return index.data(role).isValid(); });
}

/// The next cell of the row that is shown; not valid at its end.
QModelIndex shownBeside(const QTreeView& view, QModelIndex index, int direction) {
    do {
        index = index.siblingAtColumn(index.column() + direction);
    } while (index.isValid() && view.isColumnHidden(index.column()));
    return index;
}

/// Words that a cell shows a part of: its own, or those of a cell before it without room, which run on over
/// empty cells. Not valid where there are none.
struct RunningWords {
    QModelIndex index;
    QRect rect; ///< from the cell that they begin in to the last that is empty
};

RunningWords runningWords(const QTreeView& view, const QModelIndex& index, int space) {
    QModelIndex origin = index;
    while (origin.isValid() && isEmpty(origin)) {
        origin = shownBeside(view, origin, -1);
    }
    if (!origin.isValid() || CellDelegate::isNumber(origin) || origin.data(Qt::CheckStateRole).isValid()) {
        return {};
    }
    RunningWords words{origin, view.visualRect(origin)};
    const QString text = origin.data().toString() + origin.data(kSuffixRole).toString();
    if (view.fontMetrics().horizontalAdvance(text) + 2 * space < words.rect.width()) {
        return {};
    }
    for (QModelIndex beside = shownBeside(view, origin, 1); beside.isValid() && isEmpty(beside);
         beside = shownBeside(view, beside, 1)) {
        words.rect.setRight(words.rect.right() + view.columnWidth(beside.column()));
    }
    return words;
}

/// What words in the cell before leave of its room: a value without room runs on over that.
int roomBefore(const QTreeView& view, const QModelIndex& index, int space) {
    const QModelIndex before = shownBeside(view, index, -1);
    const bool isWords = before.isValid() && !CellDelegate::isNumber(before) &&
                         !before.data(Qt::CheckStateRole).isValid() && !before.data(kDotRole).isValid();
    if (!isWords) {
        return 0;
    }
    const QString text = before.data().toString() + before.data(kSuffixRole).toString();
    const int own = view.fontMetrics().horizontalAdvance(text) + 3 * space;
    return std::max(0, view.visualRect(before).width() - own);
}

void paintMarks(QPainter& painter, const QRectF& rect, const QList<float>& marks) {
    constexpr double kWide = 1.5;
    const double step = rect.width() / (kPlaces - 1);
    for (qsizetype i = 0; i < marks.size(); ++i) {
        if (marks[i] > 0) {
            const double right = rect.right() - step * static_cast<double>(marks.size() - 1 - i);
            painter.fillRect(
                QRectF(right - kWide, rect.bottom() - rect.height() / 3, kWide, rect.height() / 3),
                theme().warning);
        }
    }
}

void paintSeries(QPainter& painter, const QRectF& rect, const QList<float>& series) {
    float least = std::numeric_limits<float>::max();
    float most = 0;
    for (const float value : series) {
        if (std::isfinite(value)) {
            least = std::min(least, value);
            most = std::max(most, value);
        }
    }
    const float spread = std::max(most - least, std::max(kLeastSpread * most, 1e-6F));
    const float bottom = (most + least - spread) / 2;
    // The newest value is at the right edge; a short history leaves the left empty.
    const double step = rect.width() / (kPlaces - 1);
    QPainterPath path;
    bool isDown = false;
    for (qsizetype i = 0; i < series.size(); ++i) {
        if (!std::isfinite(series[i])) {
            isDown = false;
            continue;
        }
        const QPointF point(rect.right() - step * static_cast<double>(series.size() - 1 - i),
                            rect.bottom() - rect.height() * (series[i] - bottom) / spread);
        isDown ? path.lineTo(point) : path.moveTo(point);
        isDown = true;
    }
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    painter.drawPath(path);
}

/// Paints a range as a line along the bottom, the part in use in colour and what is beyond as a warning.
void paintBar(QPainter& painter, const QRectF& rect, const QList<float>& bar) {
    constexpr qsizetype kNumbers = 5;
    const auto numbers = std::minmax_element(bar.begin(), bar.end());
    if (bar.size() != kNumbers || *numbers.second <= *numbers.first) {
        return;
    }
    const double line = std::max(2.0, rect.height() / 9);
    const double scale = rect.width() / (*numbers.second - *numbers.first);
    const auto fill = [&](float from, float to, const QColor& colour) {
        if (to > from) {
            painter.fillRect(QRectF(rect.left() + scale * (from - *numbers.first), rect.bottom() - line,
                                    scale * (to - from), line),
                             colour);
        }
    };
    fill(bar[0], bar[1], theme().line);
    fill(std::max(bar[0], bar[2]), std::min(bar[1], bar[3]), theme().accent);
    fill(bar[2], std::min(bar[0], bar[3]), theme().warning);
    fill(std::max(bar[1], bar[2]), bar[3], theme().warning);
    const double at =
        std::clamp(rect.left() + scale * (bar[4] - *numbers.first), rect.left() + 1, rect.right() - 1);
    painter.fillRect(QRectF(at - 1, rect.bottom() - line - 1, 2, line + 1), theme().text);
}

/// Beside a number: dim, smaller, in a column of its own, where there is room for both. Returns where the
/// number ends.
int paintShare(QPainter& painter, const QRect& rect, const QString& number, const QString& share,
               bool isSelected) {
    const int numberWidth = std::max(painter.fontMetrics().horizontalAdvance(number),
                                     painter.fontMetrics().horizontalAdvance(QStringLiteral("9 999")));
    const QFont font = painter.font();
    QFont small = font;
    small.setPixelSize(std::max(8, QFontInfo(font).pixelSize() * 7 / 8));
    painter.setFont(small);
    const int reserved = painter.fontMetrics().horizontalAdvance(QStringLiteral(" <0.1 %"));
    const bool isRoom = numberWidth + reserved <= rect.width();
    if (isRoom) {
        painter.setPen(isSelected ? onSelection(theme().dim) : theme().dim);
        painter.drawText(rect, Qt::AlignRight | Qt::AlignVCenter, share);
    }
    painter.setFont(font);
    return rect.right() - (isRoom ? reserved : 0);
}

/// Returns whether a cell holds a number and `text` would be wider than the cell.
bool lacksRoom(const QTreeView& view, const QModelIndex& index, const QString& text) {
    const QFontMetrics metrics(tabularFont());
    return CellDelegate::isNumber(index) &&
           metrics.horizontalAdvance(text) + 2 * CellDelegate::margin(metrics) >
               view.visualRect(index).width();
}

/// Returns the data that a cell is painted from, its text first.
QVariantList contentOf(const QModelIndex& index) {
    constexpr std::array<int, 10> kRoles{
        Qt::DisplayRole, Qt::ForegroundRole, Qt::CheckStateRole, kDotRole,   kSwatchRole,
        kSuffixRole,     kShortTextRole,     kSeriesRole,        kMarksRole, kBarRole};
    QVariantList content;
    std::ranges::transform(kRoles, std::back_inserter(content), [&](int role) { return index.data(role); });
    return content;
}

QRectF squareBefore(const QRect& rect, int side) {
    return {static_cast<qreal>(rect.left()), rect.center().y() - side / 2.0 + 0.5, static_cast<qreal>(side),
            static_cast<qreal>(side)};
}

void paintText(QPainter& painter, QRect rect, const QStyleOptionViewItem& option, const QModelIndex& index) {
    const QVariant dot = index.data(kDotRole);
    const QVariant swatch = index.data(kSwatchRole);
    QString suffix = index.data(kSuffixRole).toString();
    const QFontMetrics metrics = painter.fontMetrics();
    const bool isSelected = option.state.testFlag(QStyle::State_Selected);
    const QVariant given = index.data(Qt::ForegroundRole);
    const QColor colour = given.isValid() ? given.value<QColor>() : theme().text;
    const QString shown = metrics.elidedText(option.text, Qt::ElideRight, rect.width());
    const int side = std::max(7, metrics.ascent() * 3 / 4);
    if (CellDelegate::isNumber(index) && swatch.isValid()) {
        rect.setLeft(
            std::max(rect.left(), rect.right() - metrics.horizontalAdvance(shown) - side - side * 2 / 3));
    }
    if (dot.isValid()) {
        rect.setLeft(rect.left() +
                     CellDelegate::paintBefore(painter, rect, side, dot.value<CharacterMark>()));
    } else if (swatch.isValid()) {
        rect.setLeft(rect.left() + CellDelegate::paintBefore(painter, rect, side, swatch.value<QColor>()));
    }
    painter.setPen(isSelected ? onSelection(colour) : colour);
    if (CellDelegate::isNumber(index)) {
        if (index.data(kSuffixRole).isValid()) {
            rect.setRight(paintShare(painter, rect, option.text, suffix, isSelected));
            painter.setPen(isSelected ? onSelection(colour) : colour);
        }
        painter.drawText(rect, Qt::AlignRight | Qt::AlignVCenter, shown);
        return;
    }
    // A short suffix, such as an ID, distinguishes equal names: the text gives way. A long one gives way
    // itself.
    const auto widthWith = [&metrics](const QString& words) {
        return words.isEmpty() ? 0 : metrics.horizontalAdvance(QLatin1Char(' ') + words);
    };
    const QVariant shorter = index.data(kShortTextRole);
    // An advance is rounded: what seems to fit to the pixel may yet be cut.
    const bool isWhole =
        !shorter.isValid() || metrics.elidedText(option.text, Qt::ElideRight, rect.width()) == option.text;
    const QString whole = isWhole ? option.text : shorter.toString();
    if (shorter.isValid() && widthWith(suffix) > rect.width() - metrics.horizontalAdvance(whole)) {
        suffix.clear(); // what it is added to matters more
    }
    const int suffixWidth = widthWith(suffix);
    const int reserved = suffixWidth <= rect.width() / 2 ? suffixWidth : 0;
    const QString text = metrics.elidedText(whole, Qt::ElideRight, std::max(0, rect.width() - reserved));
    paintMarked(painter, rect, text, isSelected ? onSelection(theme().text) : theme().text);
    rect.setLeft(rect.left() + metrics.horizontalAdvance(text + QLatin1Char(' ')));
    const QString added = metrics.elidedText(suffix, Qt::ElideLeft, rect.width()); // ports, counts
    if (added.size() > 1) { // an ellipsis alone says nothing
        painter.setPen(isSelected ? onSelection(theme().dim) : theme().dim);
        painter.drawText(rect, Qt::AlignLeft | Qt::AlignVCenter, added);
    }
}

} // namespace

bool CellDelegate::isNumber(const QModelIndex& index) {
    return (index.data(Qt::TextAlignmentRole).toInt() & Qt::AlignRight) != 0;
}

int CellDelegate::paintBefore(QPainter& painter, const QRect& rect, int side, const CharacterMark& mark) {
    paintMark(painter, squareBefore(rect, side), mark);
    return side + side * 2 / 3;
}

int CellDelegate::paintBefore(QPainter& painter, const QRect& rect, int side, const QColor& swatch) {
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(swatch);
    painter.drawRoundedRect(squareBefore(rect, side), 2, 2);
    painter.restore();
    return side + side * 2 / 3;
}

int CellDelegate::margin(const QFontMetrics& metrics) {
    return std::max(4, metrics.height() * 2 / 5);
}

int CellDelegate::rowHeight(const QFontMetrics& metrics) {
    return metrics.height() + metrics.height() * 8 / 15;
}

QSize CellDelegate::sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const {
    QStyleOptionViewItem filled = option;
    initStyleOption(&filled, index);
    const QString suffix = index.data(kSuffixRole).toString();
    const int width = filled.fontMetrics.horizontalAdvance(filled.text + suffix);
    return {width + 2 * margin(filled.fontMetrics), rowHeight(filled.fontMetrics)};
}

void CellDelegate::paint(QPainter* painter, const QStyleOptionViewItem& given,
                         const QModelIndex& index) const {
    constexpr qsizetype kMostCells = 10'000; // includes cells of removed rows
    if (m_painted.size() >= kMostCells) {
        m_painted.clear();
    }
    m_painted[index] = contentOf(index);
    QStyleOptionViewItem option = given;
    initStyleOption(&option, index);
    const QStyle* style = option.widget != nullptr ? option.widget->style() : QApplication::style();
    QStyleOptionViewItem background = option;
    background.text.clear();
    background.icon = {};
    background.state.setFlag(QStyle::State_HasFocus, false);
    style->drawControl(QStyle::CE_ItemViewItem, &background, painter, option.widget);

    const int space = margin(option.fontMetrics);
    QRect rect = option.rect.adjusted(space, 0, -space, 0);
    if (option.features.testFlag(QStyleOptionViewItem::HasCheckIndicator)) {
        const QRect box =
            style->subElementRect(QStyle::SE_ItemViewItemCheckIndicator, &option, option.widget);
        rect.setLeft(box.right() + space);
    }
    painter->save();
    painter->setClipRect(option.rect);
    if (isNumber(index)) {
        QFont font = tabularFont();
        font.setPixelSize(QFontInfo(option.font).pixelSize());
        option.font = font;
    }
    painter->setFont(option.font);
    if (const QVariant bar = index.data(kBarRole); bar.isValid()) {
        paintBar(*painter, QRectF(rect), bar.value<QList<float>>());
    }
    const QVariant series = index.data(kSeriesRole);
    if (series.isValid()) {
        const QVariant colour = index.data(Qt::ForegroundRole);
        painter->setPen(QPen(colour.isValid() ? colour.value<QColor>() : theme().accent, 1.3));
        const int inset = option.rect.height() / 5;
        const QRectF place(rect.adjusted(0, inset, 0, -inset));
        paintSeries(*painter, place, series.value<QList<float>>());
        paintMarks(*painter, place, index.data(kMarksRole).value<QList<float>>());
    } else {
        const auto* view = qobject_cast<const QTreeView*>(option.widget);
        const RunningWords words = view != nullptr ? runningWords(*view, index, space) : RunningWords{};
        if (words.index.isValid()) {
            option.text = words.index.data().toString();
            paintText(*painter, words.rect.adjusted(space, 0, -space, 0), option, words.index);
        } else {
            const int missing = painter->fontMetrics().horizontalAdvance(option.text) - rect.width();
            if (view != nullptr && isNumber(index) && missing > 0) {
                rect.setLeft(rect.left() - std::min(missing + 1, roomBefore(*view, index, space)));
                painter->setClipRect(rect.adjusted(0, 0, space, 0));
            }
            paintText(*painter, rect, option, index);
        }
    }
    painter->restore();
}

QRegion CellDelegate::takeStale(const QTreeView& view) {
    QRegion region;
    const QRect sight = view.viewport()->rect();
    for (QModelIndex row = view.indexAt({0, 0}); row.isValid(); row = view.indexBelow(row)) {
        const QRect whole = view.visualRect(row);
        if (whole.top() > sight.bottom()) {
            break;
        }
        for (QModelIndex cell = row; cell.isValid(); cell = shownBeside(view, cell, 1)) {
            const QVariantList now = contentOf(cell);
            const QVariantList before = std::exchange(m_painted[cell], now);
            QRect rect = view.visualRect(cell);
            if (before == now) {
                continue;
            }
            if (isEmpty(cell) || before.value(0).toString().isEmpty() || !rect.intersects(sight)) {
                region += QRect(sight.left(), whole.top(), sight.width(), whole.height());
                continue;
            }
            // Words continue over empty cells; a wide number uses the room that the words before it leave.
            QModelIndex beside = shownBeside(view, cell, 1);
            for (; beside.isValid() && isEmpty(beside); beside = shownBeside(view, beside, 1)) {
                rect |= view.visualRect(beside);
            }
            if (lacksRoom(view, beside, beside.data().toString())) {
                rect |= view.visualRect(beside);
            }
            if (lacksRoom(view, cell, before[0].toString()) || lacksRoom(view, cell, now[0].toString())) {
                rect |= view.visualRect(shownBeside(view, cell, -1));
            }
            region += rect;
        }
    }
    return region;
}

} // namespace posewire::gui
