// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/accounting/stream_figures.h"
#include "core/model/accounting/thresholds.h"

#include <optional>
#include <span>
#include <string_view>

namespace posewire::model {

struct ThresholdRow {
    double Thresholds::*limit;
    std::string_view key; ///< in settings
    const char* label;    ///< in a form, "&" before its mnemonic
    const char* unit;     ///< as it follows a number
    const char* help;
    double least; ///< that makes sense; 0: the threshold can be switched off
    double most;
    double shownPerUnit = 1;        ///< people see this many times the value
    std::optional<Figure> figure{}; ///< whose limit it is, in the window
    EventKind alert{};              ///< where it is exceeded, of a figure
};

/// All thresholds, in the order of forms.
[[nodiscard]] std::span<const ThresholdRow> thresholdTable();

} // namespace posewire::model
