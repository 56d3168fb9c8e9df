// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/shown_character.h"
#include "app/gui/theme/widgets.h"

#include <optional>

namespace posewire::gui {

/// Choice between the range that is selected, if there is one, and all there is.
class RangeBox final : public ComboBox {
    Q_OBJECT

public:
    RangeBox(model::SessionView& view, QWidget* parent) : ComboBox(parent), m_view(view) {
        if (const auto range = view.range()) {
            addItem(rangeText(view, *range), true);
        }
        addItem(tr("All there is"), false);
    }

    /// Nothing for all there is.
    [[nodiscard]] std::optional<model::TimeRange> range() const {
        return currentData().toBool() ? m_view.range() : std::nullopt;
    }

private:
    model::SessionView& m_view;
};

} // namespace posewire::gui
