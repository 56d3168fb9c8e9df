// SPDX-License-Identifier: MIT
#include "core/model/session/session.h"

#include <set>

namespace posewire::model {

bool Session::forget(log::SenderId sender) {
    const auto passedOn = [&](const std::set<CharacterKey>& keys) {
        std::set<CharacterKey> heirs;
        for (const CharacterKey& key : keys) {
            heirs.insert(key.sender == sender ? atNow().roster().current(key) : key);
        }
        std::erase_if(heirs, [sender](const CharacterKey& key) { return key.sender == sender; });
        return heirs;
    };
    std::set<CharacterKey> hidden = passedOn(m_choices.hidden);
    std::set<CharacterKey> lifted = passedOn(m_choices.lifted);
    Selection selection = m_choices.selection;
    if (selection.character && selection.character->sender == sender) {
        selection.character = atNow().roster().current(*selection.character);
        selection.sender = selection.character->sender;
    }
    if (!m_ingest.forget(sender)) {
        return false;
    }
    m_choices.hidden = std::move(hidden);
    m_choices.lifted = std::move(lifted);
    m_choices.selection = selection.sender == sender ? Selection{} : selection;
    return true;
}

void Session::report(IncidentKind kind, log::Stamp now, words::Fact detail, log::SenderId sender) {
    Occurrence one = Occurrence::at(kind, sender, now, end() == 0 ? 0 : end() - 1);
    one.detail = std::move(detail);
    m_ingest.incidents().report(one);
}

} // namespace posewire::model
