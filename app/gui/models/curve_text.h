// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/field_document.h"

#include <QStringList>

class QMimeData;

/// Signals as texts: what can be plotted of what docks show.
namespace posewire::gui {

/// Of a node of the inspector: a number as it is, of a vector each component, such as `02.position.z of "Left
/// Hand"`; empty if it is no number.
[[nodiscard]] QStringList curvesOf(const FieldDocument& document, std::int32_t node);

/// Each component of a vector of a tracker, by the field's name in type 23.
[[nodiscard]] QStringList curvesOfTracker(const char* field, std::uint32_t id);

/// Wraps curves that are dragged from dock to dock; the second unwraps them, and returns none for other data.
[[nodiscard]] QMimeData* asDragged(const QStringList& curves);
[[nodiscard]] QStringList draggedCurves(const QMimeData& data);

} // namespace posewire::gui
