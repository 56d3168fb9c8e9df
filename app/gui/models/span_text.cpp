// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/span_text.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"

#include <algorithm>

namespace posewire::gui {

std::optional<model::TimeRange> wholeSpan(const model::SessionView& view) {
    if (view.end() == 0 || view.firstStamp() == log::Stamp()) {
        return std::nullopt;
    }
    const auto newest = view.isRecording() ? view.packet(view.end() - 1) : std::nullopt;
    const log::Stamp end = newest ? newest->stamp : view.now();
    return model::TimeRange{view.firstStamp(), std::max(end, view.firstStamp()) + log::Duration(1)};
}

QString spanText(const model::SessionView& view) {
    const auto whole = wholeSpan(view);
    if (!whole) {
        return {};
    }
    const auto range = view.range();
    if (!range) {
        return tr("all, %1").arg(duration(whole->seconds()));
    }
    const QString length = duration(range->seconds());
    if (view.rangeChoice().isSinceReset) {
        return tr("since reset, %1").arg(length);
    }
    if (!view.rangeChoice().fixed) {
        return tr("last %1").arg(length);
    }
    return tr("selection %1 + %2").arg(timeOfDay(view.wallOf(range->from)).chopped(2), length);
}

} // namespace posewire::gui
