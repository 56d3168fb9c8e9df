// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/character_mark.h"

#include <QHash>
#include <QStyledItemDelegate>

class QTreeView;

namespace posewire::gui {

/// Paints what models/column.h knows: marks, swatches, dim suffixes, small curves; numbers in tabular
/// figures.
class CellDelegate : public QStyledItemDelegate {
    Q_OBJECT

public:
    using QStyledItemDelegate::QStyledItemDelegate;

    void paint(QPainter* painter, const QStyleOptionViewItem& given, const QModelIndex& index) const override;
    [[nodiscard]] QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;

    /// Returns the parts of `view` whose data changed since they were painted; the caller repaints them.
    [[nodiscard]] QRegion takeStale(const QTreeView& view);

    /// Room at the left and the right of a cell's text.
    [[nodiscard]] static int margin(const QFontMetrics& metrics);
    [[nodiscard]] static int rowHeight(const QFontMetrics& metrics);
    [[nodiscard]] static bool isNumber(const QModelIndex& index);
    // Paint a mark or a square of `side` pixels before a text, and return its width with the space after it.
    static int paintBefore(QPainter& painter, const QRect& rect, int side, const CharacterMark& mark);
    static int paintBefore(QPainter& painter, const QRect& rect, int side, const QColor& swatch);

private:
    mutable QHash<QModelIndex, QVariantList> m_painted; ///< data that each cell was painted from
};

} // namespace posewire::gui
