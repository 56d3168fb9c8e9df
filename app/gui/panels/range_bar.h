// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/panels/range_strip.h"
#include "core/log/time.h"

#include <vector>

class QToolButton;

namespace posewire::gui {

/// The strip of the history with buttons for the newest ten seconds, the newest minute and all.
class RangeBar : public QWidget {
    Q_OBJECT

public:
    RangeBar(model::SessionView& view, Commands& commands, QWidget* parent);

    void refresh();

    /// "last 10 s", "10:42:17.5 + 2.1 s"; empty for all.
    [[nodiscard]] QString rangeText() const;

private:
    void addButton(const QString& text, const QString& toolTip, log::Duration last);

    struct Button {
        QToolButton* button;
        log::Duration last; ///< 0 for all
    };

    model::SessionView& m_view;
    Commands& m_commands;
    RangeStrip* m_strip;
    std::vector<Button> m_buttons;
};

} // namespace posewire::gui
