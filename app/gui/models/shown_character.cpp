// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/shown_character.h"

#include "app/gui/models/text.h"

#include <algorithm>

namespace posewire::gui {

std::optional<model::CharacterKey> shownCharacter(model::SessionView& view) {
    const model::Selection& selection = view.selection();
    if (selection.character && view.find(*selection.character) != nullptr) {
        return view.current(*selection.character);
    }
    const auto characters = view.currentCharacters();
    const auto first = std::ranges::find_if(characters, [&](const model::Character* character) {
        return !selection.sender || character->key.sender == *selection.sender;
    });
    return first == characters.end() ? std::nullopt : std::optional((*first)->key);
}

model::Selection selectionOf(model::SessionView& view, const model::CharacterKey& key) {
    model::Selection selection = view.selection();
    if (selection.character != key) {
        selection.segment = -1;
    }
    selection.sender = key.sender;
    selection.character = key;
    return selection;
}

QString characterName(model::SessionView& view, const model::CharacterKey& key) {
    return shown(view.displayName(key));
}

CharacterMark characterMark(model::SessionView& view, const model::CharacterKey& key) {
    const model::Colour colour = view.colour(key);
    return {QColor::fromRgbF(std::clamp(colour.red, 0.0F, 1.0F), std::clamp(colour.green, 0.0F, 1.0F),
                             std::clamp(colour.blue, 0.0F, 1.0F)),
            key.character};
}

std::uint64_t newestVisiblePacket(model::SessionView& view) {
    const std::uint64_t newest = view.end() == 0 ? 0 : view.end() - 1;
    return view.cursor().mode == model::Cursor::Mode::Paused ? std::min(view.cursor().packet, newest)
                                                             : newest;
}

} // namespace posewire::gui
