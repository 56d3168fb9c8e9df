// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/theme/theme.h"

#include <QString>
#include <QVariant>

namespace posewire::gui {

/// What one cell says, made whenever it is painted: in shape, colour and text.
struct PropertyValue {
    QString text{};
    Health health = Health::Unknown; ///< other than Unknown: shown with its symbol and colour
    QString toolTip{};

    /// "▲ 31", or the text alone where health is unknown.
    [[nodiscard]] QString display() const;
    /// The same without a symbol, for screen readers: "warning, 31".
    [[nodiscard]] QString spoken() const;
    /// Of the health; nothing where it is unknown.
    [[nodiscard]] QVariant colour() const;
};

} // namespace posewire::gui
