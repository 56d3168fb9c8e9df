// SPDX-License-Identifier: MIT
#include "core/model/session/session.h"

#include <set>

namespace posewire::model {

bool Session::forget(log::SenderId sender) {
    std::set<CharacterKey> heirs; // of those that are hidden
    for (const CharacterKey& key : m_choices.hidden) {
        heirs.insert(key.sender == sender ? currentNow(key) : key);
    }
    Selection selection = m_choices.selection;
    if (selection.character && selection.character->sender == sender) {
        selection.character = currentNow(*selection.character);
        selection.sender = selection.character->sender;
    }
    if (!m_ingest.forget(sender)) {
        return false;
    }
    std::erase_if(heirs, [sender](const CharacterKey& key) { return key.sender == sender; });
    m_choices.hidden = std::move(heirs);
    m_choices.selection = selection.sender == sender ? Selection{} : selection;
    return true;
}

} // namespace posewire::model
