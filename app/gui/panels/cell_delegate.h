// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStyledItemDelegate>

namespace posewire::gui {

/// Paints what models/column.h knows: dots, swatches, dim suffixes, small curves; numbers in tabular figures.
class CellDelegate : public QStyledItemDelegate {
    Q_OBJECT

public:
    using QStyledItemDelegate::QStyledItemDelegate;

    void paint(QPainter* painter, const QStyleOptionViewItem& given, const QModelIndex& index) const override;
    [[nodiscard]] QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;

    /// Room at the left and the right of a cell's text.
    [[nodiscard]] static int margin(const QFontMetrics& metrics);
    [[nodiscard]] static int rowHeight(const QFontMetrics& metrics);
    [[nodiscard]] static bool isNumber(const QModelIndex& index);
    /// Paints a dot or a square of `side` pixels before a text and returns its width with the space after it.
    static int paintMark(QPainter& painter, const QRect& rect, int side, const QColor& colour, bool isDot);
};

} // namespace posewire::gui
