// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/comparison_text.h"

#include "app/gui/models/text.h"
#include "app/gui/theme/theme.h"
#include "app/gui/theme/words.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace posewire::gui {
namespace {

QColor between(const QColor& from, const QColor& to, double share) {
    const auto mix = [share](double a, double b) { return static_cast<float>(a + share * (b - a)); };
    return QColor::fromRgbF(mix(from.redF(), to.redF()), mix(from.greenF(), to.greenF()),
                            mix(from.blueF(), to.blueF()));
}

} // namespace

QString alignedByText(exporting::AlignBy by) {
    const std::array words{tr("Time code"), tr("Sample counter"), tr("Beginnings")}; // by AlignBy
    return words[static_cast<std::size_t>(by)];
}

QString frameText(model::DifferenceFrame frame) {
    const std::array words{tr("As sent"), tr("On the spot"), tr("Without the pelvis")}; // by DifferenceFrame
    return words[static_cast<std::size_t>(frame)];
}

QString offsetText(const exporting::Alignment& alignment) {
    if (alignment.offset == 0) {
        return {};
    }
    if (alignment.by != exporting::AlignBy::Sample) {
        return tr("%1 ms").arg(signedFixed(alignment.offset, 1));
    }
    return tr("%1 samples", nullptr, static_cast<int>(std::abs(alignment.offset)))
        .arg(signedFixed(alignment.offset, 0));
}

QString comparisonText(const ComparisonState& state) {
    if (!state.isOpen) {
        return {};
    }
    if (!state.alignment) {
        return tr("compared with %1").arg(state.name);
    }
    const QString by = alignedByText(state.alignment->by);
    const QString offset = offsetText(*state.alignment);
    return offset.isEmpty() ? tr("compared with %1 · %2").arg(state.name, by)
                            : tr("compared with %1 · %2, %3").arg(state.name, by, offset);
}

QStringList comparedText(const ComparisonState& state) {
    QStringList parts;
    if (!state.atCursor && state.alignment) {
        parts += tr("No partner at this moment");
    }
    if (state.range != nullptr) {
        parts += tr("%1 pairs").arg(grouped(state.range->pairs));
        const auto add = [&parts](std::uint64_t count, const QString& text) {
            parts += count != 0 ? QStringList(text.arg(grouped(count))) : QStringList();
        };
        add(state.range->alone, tr("%1 without a partner"));
        add(state.range->outside, tr("%1 outside the common time"));
        add(state.range->apart, tr("%1 without a common segment"));
        add(state.range->passedOver, tr("%1 packets not looked at in time"));
    }
    return parts + state.notes;
}

QColor DifferenceScale::colourOf(double millimetres) const {
    const double share = std::clamp(millimetres / full, 0.0, 1.0);
    const Theme& colours = theme();
    return share < 0.5 ? between(colours.good, colours.warning, 2 * share)
                       : between(colours.warning, colours.error, 2 * share - 1);
}

DifferenceScale scaleOf(const ComparisonState& state) {
    const double most = state.range != nullptr ? state.range->all.millimetres.p95
                        : state.atCursor       ? state.atCursor->meanMillimetres()
                                               : 0;
    double full = 1;
    for (const double next : {2.0, 2.5, 2.0, 2.0, 2.5, 2.0, 2.0, 2.5, 2.0, 2.0, 2.5, 2.0}) { // 1 2 5 10 …
        if (full >= most) {
            break;
        }
        full *= next;
    }
    return {full};
}

} // namespace posewire::gui
