// SPDX-License-Identifier: MIT
#include "core/model/session/session_view.h"

#include <algorithm>

/// Who is who: a character is the same one through restarts of its sender.
namespace posewire::model {

ForeignText SessionView::addressOf(log::SenderId id) const {
    if (const Sender* sender = find(id)) {
        return sender->address();
    }
    const FormerSender* former = m_ingest.former(id);
    return id == log::kNoSender ? "this computer"
           : former != nullptr  ? ForeignText(former->address)
                                : ForeignText("a retired sender");
}

ForeignText SessionView::displayName(const CharacterKey& key) const {
    if (const FormerSender* former = find(key) == nullptr ? m_ingest.former(key.sender) : nullptr) {
        const auto known =
            std::ranges::find(former->names, key.character, &std::pair<std::uint8_t, ForeignText>::first);
        if (known != former->names.end()) {
            return known->second;
        }
    }
    const ForeignText& name = metadataValue(key, "name");
    return name.isEmpty() ? ForeignText("Character " + std::to_string(key.character)) : name;
}

const Character* SessionView::predecessor(const CharacterKey& key) const {
    const Character* character = find(key);
    const Character* before = character != nullptr && character->before ? find(*character->before) : nullptr;
    return before != nullptr && before->lastPacket < character->firstPacket ? before : nullptr;
}

const Character* SessionView::successor(const Character& character) const {
    const Character* next = character.after ? find(*character.after) : nullptr;
    const bool hasTakenOver =
        next != nullptr && next->firstPacket < visibleEnd() && next->firstPacket > character.lastPacket;
    return hasTakenOver ? next : nullptr;
}

bool SessionView::isSuperseded(const CharacterKey& key) const {
    const Character* character = find(key);
    return character != nullptr && successor(*character) != nullptr;
}

CharacterKey SessionView::current(const CharacterKey& key) const {
    CharacterKey current = key;
    for (const Character* character = find(key); character != nullptr; character = successor(*character)) {
        current = character->key;
    }
    return current;
}

std::vector<const Character*> SessionView::currentCharacters() const {
    using Appearing = std::pair<std::uint64_t, const Character*>;
    std::vector<Appearing> appearing;
    for (const Character& character : characters()) {
        if (findListed(character.key) != nullptr) {
            appearing.emplace_back(appearance(character), &character);
        }
    }
    std::ranges::stable_sort(appearing, {}, &Appearing::first);
    std::vector<const Character*> shown(appearing.size());
    std::ranges::transform(appearing, shown.begin(), &Appearing::second);
    return shown;
}

const Character* SessionView::findListed(const CharacterKey& key) const {
    const Character* character = find(key);
    const Character* earlier = predecessor(key);
    const bool hasBegun = earlier == nullptr || successor(*earlier) == character;
    const bool isListed =
        character != nullptr && character->isConfirmed && hasBegun && successor(*character) == nullptr;
    return isListed ? character : nullptr;
}

std::vector<const Character*> SessionView::lineage(const CharacterKey& key) const {
    std::vector<const Character*> line;
    for (const Character* one = find(key); one != nullptr; one = predecessor(one->key)) {
        line.push_back(one);
    }
    std::ranges::reverse(line);
    return line;
}

/// Of the first packet of the first of its line, listed or not.
std::uint64_t SessionView::appearance(const Character& character) const {
    const Character* first = &character;
    for (const Character* one = first; one != nullptr; one = predecessor(one->key)) {
        first = one;
    }
    return first->formerFirstPacket.value_or(first->firstPacket);
}

bool SessionView::isSame(const CharacterKey& a, const CharacterKey& b) const {
    return a == b || atNow().current(a) == atNow().current(b);
}

/// Itself, or what it was before or after a restart.
bool SessionView::isIn(const std::set<CharacterKey>& keys, const CharacterKey& key) const {
    return !keys.empty() && (keys.contains(key) ||
                             std::ranges::any_of(lineage(atNow().current(key)),
                                                 [&](const auto* one) { return keys.contains(one->key); }));
}

bool SessionView::isHidden(const CharacterKey& key) const {
    return isIn(m_choices.hidden, key);
}

bool SessionView::isLifted(const CharacterKey& key) const {
    return isIn(m_choices.lifted, key);
}

std::uint64_t SessionView::restartsOf(const CharacterKey& key) const {
    const auto line = lineage(key);
    std::uint64_t restarts = line.empty() ? 0 : line.size() - 1;
    for (const Character* one : line) {
        restarts += one->formerRestarts + one->counterRestarts();
    }
    return restarts;
}

std::vector<const Sender*> SessionView::endedSenders() const {
    std::vector<const Sender*> ended;
    for (const Sender& sender : senders()) {
        if (m_ingest.hasEnded(sender)) {
            ended.push_back(&sender);
        }
    }
    return ended;
}

Unproven SessionView::unproven() const {
    Unproven sums;
    for (const Character& character : characters()) {
        if (!character.isConfirmed) {
            ++sums.characters;
            for (const Stream* stream : character.streams) {
                sums.datagrams += stream->accounting.datagrams();
            }
        }
    }
    return sums;
}

} // namespace posewire::model
