// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/comparison.h"

#include <QColor>
#include <QString>

namespace posewire::gui {

/// "Time code", "Sample counter", "Beginnings".
[[nodiscard]] QString alignedByText(exporting::AlignBy by);
/// "As sent", "On the spot", "Without the pelvis".
[[nodiscard]] QString frameText(model::DifferenceFrame frame);

/// "+12.5 ms", "−3 samples"; empty for none.
[[nodiscard]] QString offsetText(const exporting::Alignment& alignment);

/// "compared with take-2.pcapng · Time code, +12.5 ms"; empty if nothing is compared.
[[nodiscard]] QString comparisonText(const ComparisonState& state);

/// How much of the range was compared, and what the operator must know of that; a few words each.
[[nodiscard]] QStringList comparedText(const ComparisonState& state);

/// From good over warning to error.
struct DifferenceScale {
    double full = 10; ///< mm, from here on it is an error's colour

    [[nodiscard]] QColor colourOf(double millimetres) const;
};

/// Up to what 95 % of all differences of the range are below, rounded up to 1, 2 or 5 of a power of ten; at
/// least 1 mm.
[[nodiscard]] DifferenceScale scaleOf(const ComparisonState& state);

} // namespace posewire::gui
