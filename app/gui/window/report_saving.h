// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/model/session/session_view.h"

#include <QString>

#include <optional>

class QWidget;

namespace posewire::gui {

/// Writes a report on the streams, of a range of time or of all there is. The answer is what went wrong,
/// empty for nothing.
[[nodiscard]] QString writeStreamReport(model::SessionView& session,
                                        const std::optional<model::TimeRange>& range, const QString& path);

/// Asks for the range, where one is chosen, and for the name; offers to open the file. Returns a line to
/// say, empty where the operator cancelled.
[[nodiscard]] QString saveStreamReport(model::SessionView& session, QWidget* parent);

} // namespace posewire::gui
