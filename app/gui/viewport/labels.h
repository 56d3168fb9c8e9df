// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/character_mark.h"
#include "app/gui/viewport/captions.h"
#include "app/gui/viewport/scene.h"

#include <QColor>
#include <QPointF>
#include <QRectF>
#include <QString>

#include <vector>

namespace posewire::gui {

/// The label over one character.
struct ViewportLabel {
    model::CharacterKey key;
    QPointF anchor; ///< just above its head
    QRectF head;
    double depth = 0; ///< of the head, metres from the eye
    CharacterMark mark;
    QString name;
    PropertyValue state; ///< how it does
    bool isSelected = false;
    bool isBehind = false; ///< its head is hidden by somebody else
};

/// A few words of an overlay.
struct ViewportText {
    QPointF place; ///< its left end, at half its height
    QString text;
    QColor colour;
};

/// Of the figures in a picture of that size, in logical pixels; none of a head that is behind the eye.
[[nodiscard]] std::vector<ViewportLabel> labelsOf(const SceneFrame& frame, model::SessionView& session,
                                                  const QSizeF& size);
/// The nearest first, numbers of the floor last.
[[nodiscard]] std::vector<ViewportText> textsOf(const SceneFrame& frame, const QSizeF& size);

} // namespace posewire::gui
