// SPDX-License-Identifier: MIT
#include "core/export/comparison/character_pairs.h"

#include "core/model/session/roster.h"

#include <algorithm>
#include <map>

namespace posewire::exporting {

std::vector<CharacterPair> pairCharacters(const model::SessionView& first, const model::SessionView& second) {
    const std::vector<const model::Character*> ours = first.atNow().roster().listed();
    std::vector<const model::Character*> theirs = second.atNow().roster().listed();
    std::map<model::CharacterKey, model::CharacterKey> partners;
    const auto pairWhere = [&](auto&& isSame) {
        for (const model::Character* one : ours) {
            const auto other = std::ranges::find_if(
                theirs, [&](const model::Character* candidate) { return isSame(one->key, candidate->key); });
            if (other != theirs.end() && !partners.contains(one->key)) {
                partners.emplace(one->key, (*other)->key);
                theirs.erase(other);
            }
        }
    };
    pairWhere([&](const model::CharacterKey& one, const model::CharacterKey& other) {
        return first.roster().displayName(one) == second.roster().displayName(other);
    });
    pairWhere([](const model::CharacterKey& one, const model::CharacterKey& other) {
        return one.character == other.character;
    });
    pairWhere([](const model::CharacterKey&, const model::CharacterKey&) { return true; });
    std::vector<CharacterPair> pairs;
    for (const model::Character* one : ours) {
        if (const auto found = partners.find(one->key); found != partners.end()) {
            pairs.emplace_back(*found);
        }
    }
    return pairs;
}

} // namespace posewire::exporting
