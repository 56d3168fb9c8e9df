// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/commands.h"
#include "app/gui/models/field_document.h"

class QWidget;
class QPoint;

namespace posewire::gui {

/// The field that a menu is about, and what the menu may do.
struct FieldMenu {
    const FieldDocument& document;
    std::int32_t node;
    const std::string& displayFilter;
    Commands& commands;
};

/// Filters and copies. Returns when the menu is closed.
void showFieldMenu(const FieldMenu& field, QWidget* parent, const QPoint& at);

enum class FilterUse { Replace, Not, And, Or, AndNot };

/// `expression` joined to the filter in use; both in the filter language.
[[nodiscard]] QString joinedFilter(const QString& filter, const QString& expression, FilterUse use);

/// "3f 80 00 00", and as an initializer of C: "{0x3f, 0x80, 0x00, 0x00}".
[[nodiscard]] QString hexText(const FieldDocument& document, std::int32_t node);
[[nodiscard]] QString arrayText(const FieldDocument& document, std::int32_t node);

} // namespace posewire::gui
