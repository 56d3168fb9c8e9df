// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/span_text.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"

namespace posewire::gui {

QString spanText(const model::SessionView& view) {
    if (view.firstStamp() == log::Stamp()) {
        return {};
    }
    const auto range = view.range();
    if (!range) {
        return tr("all, %1").arg(duration(log::secondsOf(view.cursorStamp() - view.firstStamp())));
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
