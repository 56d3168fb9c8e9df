// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Qt>

namespace posewire::gui {

/// What a cell may have besides its text; CellDelegate paints it.
inline constexpr int kDotRole = Qt::UserRole + 1;    ///< QColor: a filled circle before the text
inline constexpr int kSwatchRole = Qt::UserRole + 2; ///< QColor: a square before the text
inline constexpr int kSuffixRole = Qt::UserRole + 3; ///< QString: dim text after the text
/// bool: the text of the cell before stretches over this one too.
inline constexpr int kSpanRole = Qt::UserRole + 5;
inline constexpr int kSeriesRole = Qt::UserRole + 4; ///< QList<float>: a small curve; NaN breaks it
/// QList<float>: where the curve is to be marked, as many as it has values; 0 for no mark.
inline constexpr int kMarksRole = Qt::UserRole + 6;
/// What orders rows by this column: a number where the text is one, else the text.
inline constexpr int kSortRole = Qt::UserRole + 7;

} // namespace posewire::gui
