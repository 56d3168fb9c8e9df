// SPDX-License-Identifier: MIT
#include "core/model/session/choices.h"

#include <algorithm>
#include <utility>

namespace posewire::model {

const Jump* Choices::filterJump() const {
    const auto newest = std::find_if(jumps.rbegin(), jumps.rend(),
                                     [](const Jump& jump) { return jump.filter != jump.filterBefore; });
    return newest != jumps.rend() && newest->filter == displayFilter ? &*newest : nullptr;
}

const std::string& Choices::ownFilter() const {
    const Jump* jump = filterJump();
    return jump != nullptr ? jump->filterBefore : displayFilter;
}

void Choices::jump(const Selection& to, std::string filter) {
    if (const Jump* before = filterJump()) {
        jumps.resize(static_cast<std::size_t>(before - jumps.data()) + 1);
    } else {
        leave();
    }
    jumps.back().filter = filter;
    undone.clear();
    displayFilter = std::move(filter);
    selection = to;
    if (to.packet) {
        cursor = {Cursor::Mode::Paused, *to.packet};
    }
}

void Choices::leave() {
    jumps.push_back({displayFilter, selection, cursor, displayFilter});
    jumps.back().cursorBefore.speed = 0;
    undone.clear();
    if (jumps.size() > kMostJumps) {
        jumps.erase(jumps.begin());
    }
}

bool Choices::travel(std::vector<Jump>& from, std::vector<Jump>& to) {
    if (from.empty()) {
        return false;
    }
    Jump jump = std::move(from.back());
    from.pop_back();
    to.push_back({std::exchange(displayFilter, jump.filterBefore),
                  std::exchange(selection, jump.selectionBefore), std::exchange(cursor, jump.cursorBefore),
                  displayFilter});
    return true;
}

void Choices::askForIncident(std::optional<std::uint64_t> number, std::optional<CharacterKey> of) {
    incidentRequest = {number, of, incidentRequest.count + 1};
}

} // namespace posewire::model
