// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QList>
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

private:
    void paintSeries(QPainter& painter, const QRectF& rect, const QList<float>& series) const;
    void paintMarks(QPainter& painter, const QRectF& rect, const QList<float>& marks) const;
    void paintText(QPainter& painter, QRect rect, const QStyleOptionViewItem& option,
                   const QModelIndex& index) const;
};

} // namespace posewire::gui
