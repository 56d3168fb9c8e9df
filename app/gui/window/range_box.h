// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/widgets.h"

namespace posewire::gui {

/// How much of a session a dialog is about: all there is, or the time that figures are of.
class RangeBox final : public ComboBox {
    Q_OBJECT

public:
    explicit RangeBox(QWidget* parent) : ComboBox(parent) {
        addItems({tr("All there is"), tr("The range of the figures")});
    }

    [[nodiscard]] bool isRangeOnly() const { return currentIndex() == 1; }
};

} // namespace posewire::gui
