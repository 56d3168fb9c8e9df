// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QColor>
#include <QMetaType>

class QPainter;
class QRectF;

namespace posewire::gui {

/// What a character is known by at a glance: its colour, and a shape for those who cannot tell colours apart.
/// No shape is one of those that mean good, warning and error.
struct CharacterMark {
    static constexpr int kShapes = 8;

    QColor colour;
    int shape = 0; ///< any number; kShapes are different

    friend bool operator==(const CharacterMark&, const CharacterMark&) = default;
};

void paintMark(QPainter& painter, const QRectF& place, const CharacterMark& mark);

} // namespace posewire::gui

Q_DECLARE_METATYPE(posewire::gui::CharacterMark)
