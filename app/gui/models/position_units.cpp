// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/position_units.h"

#include "core/wire/type_table.h"

namespace posewire::gui {

PositionUnits unusualPositionUnits(const model::SessionView& view) {
    const model::Sender usual{log::SenderId{}};
    PositionUnits units;
    for (const model::Sender& sender : view.senders()) {
        for (const wire::TypeInfo& info : wire::typeTable()) {
            const model::LengthUnit unit = sender.positionUnit(info.type);
            if (unit != usual.positionUnit(info.type)) {
                units.emplace(std::pair(sender.id, info.type), unit);
            }
        }
    }
    return units;
}

std::optional<model::LengthUnit> unitIn(const PositionUnits& units, log::SenderId sender, std::uint8_t type) {
    const auto found = units.find({sender, type});
    return found != units.end() ? std::optional(found->second) : std::nullopt;
}

} // namespace posewire::gui
