// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/models/column.h"

#include <QCoreApplication>
#include <QVariant>

#include <span>

namespace posewire::gui {

/// What stands over one column of a table; both texts are translated in the context of its model.
struct ColumnText {
    const char* title;
    const char* toolTip; ///< "" for none
    bool isNumber = true;
};

/// headerData() of a table whose columns are declared in a table of texts.
[[nodiscard]] QVariant columnHeader(std::span<const ColumnText> columns, const char* context, int section,
                                    int role);

} // namespace posewire::gui
