// SPDX-License-Identifier: MIT
#include "core/model/session/choices.h"

#include <utility>

namespace posewire::model {

const Jump* Choices::filterJump() const {
    const bool isInForce =
        !jumps.empty() && jumps.back().filter == displayFilter && jumps.back().filterBefore != displayFilter;
    return isInForce ? &jumps.back() : nullptr;
}

const std::string& Choices::ownFilter() const {
    const Jump* jump = filterJump();
    return jump != nullptr ? jump->filterBefore : displayFilter;
}

void Choices::jump(const Selection& to, std::string filter) {
    if (filterJump() != nullptr) {
        jumps.back().filter = filter;
    } else {
        jumps.push_back({displayFilter, selection, cursor, filter});
    }
    if (jumps.size() > kMostJumps) {
        jumps.erase(jumps.begin());
    }
    displayFilter = std::move(filter);
    selection = to;
    if (to.packet) {
        cursor = {Cursor::Mode::Paused, *to.packet};
    }
}

void Choices::goBack() {
    if (!jumps.empty()) {
        displayFilter = std::move(jumps.back().filterBefore);
        selection = jumps.back().selectionBefore;
        cursor = jumps.back().cursorBefore;
        jumps.pop_back();
    }
}

void Choices::askForIncident(std::optional<std::uint64_t> number, std::optional<CharacterKey> of) {
    incidentRequest = {number, of, incidentRequest.count + 1};
}

} // namespace posewire::model
