// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/panel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

namespace posewire::gui {

/// Has a panel carry out an entry of its table, as the menus of the window do.
template <class P>
void trigger(P& panel, std::string_view id) {
    const auto actions = P::actionTable();
    const auto found = std::ranges::find(actions, id, &ActionInfo::id);
    ASSERT_NE(found, actions.end()) << id;
    found->run(panel);
}

/// Whether the entry of a panel is checked.
template <class P>
bool isOn(const P& panel, std::string_view id) {
    const auto actions = P::actionTable();
    const auto found = std::ranges::find(actions, id, &ActionInfo::id);
    return found != actions.end() && found->isOn != nullptr && found->isOn(panel);
}

} // namespace posewire::gui
