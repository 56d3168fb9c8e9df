// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/character_mark.h"
#include "app/gui/viewport/captions.h"
#include "app/gui/viewport/scene.h"
#include "render/picking.h"

#include <QColor>
#include <QPointF>
#include <QRectF>
#include <QSizeF>
#include <QString>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace posewire::gui {

struct PickedSegment {
    model::CharacterKey key;
    int segment = -1; ///< position in the pose

    friend bool operator==(const PickedSegment&, const PickedSegment&) = default;
};

/// Picks in a frame as it is drawn, in a picture of that size in logical pixels: a prop or a tracked object
/// whose origin is near the pointer, else the nearest segment of a body.
[[nodiscard]] std::optional<PickedSegment> pickIn(const SceneFrame& frame, const QPointF& pointer,
                                                  const QSizeF& view);

/// A figure that has a body, to be met by a ray; it must outlive the target.
[[nodiscard]] render::PickTarget targetOf(const Figure& figure, std::uint32_t id);
/// Whether, in a picture of that size, somebody else is seen there nearer than the label of
/// `frame.figures[which]` is.
[[nodiscard]] bool isBehindAnother(const SceneFrame& frame, std::size_t which, const QPointF& there,
                                   const QSizeF& view);

/// The rectangle that a figure takes in a picture of that size; empty where it is not in it, or partly behind
/// the eye.
[[nodiscard]] QRectF roomOf(const SceneFrame& frame, const model::CharacterKey& key, const QSizeF& view);

struct ViewportLabel {
    model::CharacterKey key;
    QPointF anchor; ///< just above its head
    QRectF head;
    std::array<QRectF, 2> arms; ///< forearm and hand where they are raised; else empty
    double depth = 0;           ///< of the head, metres from the eye
    CharacterMark mark;
    QString name;
    PropertyValue state; ///< how it does
    bool isSelected = false;
    bool isBehind = false; ///< its head is hidden by somebody else
};

struct ViewportText {
    QPointF place; ///< its left end, at half its height
    QString text;
    QColor colour;
    bool isOfBody = false; ///< is moved aside, with a line to its place, rather than left out
    bool isHint = false;   ///< says something about the others, and has no place
};

/// Of the figures in a picture of that size, in logical pixels; none of a head that is behind the eye.
[[nodiscard]] std::vector<ViewportLabel> labelsOf(const SceneFrame& frame, model::SessionView& session,
                                                  const QSizeF& size);
/// The nearest first, those on the far sides of bodies after them and fainter, numbers of the floor last.
[[nodiscard]] std::vector<ViewportText> textsOf(const SceneFrame& frame, const QSizeF& size);

} // namespace posewire::gui
