// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/statistics_model.h"

#include <QRectF>

class QPainter;

namespace posewire::gui {

/// The whole history in a rectangle: datagrams a second, and where samples were lost.
void paintOverview(QPainter& painter, const RangeOverview& overview, const QRectF& rect);

} // namespace posewire::gui
