// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/scene.h"
#include "render/picking.h"

#include <QPointF>
#include <QRectF>
#include <QSizeF>

#include <cstddef>
#include <cstdint>
#include <optional>

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

} // namespace posewire::gui
