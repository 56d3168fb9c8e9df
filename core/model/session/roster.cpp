// SPDX-License-Identifier: MIT
#include "core/model/session/roster.h"

#include "core/log/ip_packet.h"
#include "core/model/session/choices.h"
#include "core/model/session/ingest.h"

#include <algorithm>

namespace posewire::model {
Roster::Roster(const Moment& moment) : m_moment(moment), m_roll(moment.ingest().roll()) {}

UpAxis Roster::up(log::SenderId id) const {
    const Sender* sender = find(id);
    return sender != nullptr ? sender->up() : UpAxis::Z;
}

ForeignText Roster::addressOf(log::SenderId id) const {
    if (const Sender* sender = find(id)) {
        return sender->address();
    }
    const FormerSender* former = m_roll.former(id);
    return id == log::kNoSender ? "this computer"
           : former != nullptr  ? ForeignText(former->address)
                                : ForeignText("a retired sender");
}

ForeignText Roster::displayName(const CharacterKey& key) const {
    if (const FormerSender* former = find(key) == nullptr ? m_roll.former(key.sender) : nullptr) {
        const auto known =
            std::ranges::find(former->names, key.character, &std::pair<std::uint8_t, ForeignText>::first);
        if (known != former->names.end()) {
            return known->second;
        }
    }
    const ForeignText& name = metadataValue(key, "name");
    return name.isEmpty() ? ForeignText("Character " + std::to_string(key.character)) : name;
}

std::array<std::string, 3> Roster::namesOf(const CharacterKey& key) const {
    const std::string name(displayName(key).shown());
    const std::string withId = name + '\0' + std::to_string(key.character);
    return {name, withId, withId + '\0' + std::string(log::hostOf(addressOf(key.sender).exact()))};
}

Roster::Namesakes Roster::namesakes(const CharacterKey& key) const {
    const Roster now(m_moment.now());
    if (const std::pair at(m_moment.end(), m_moment.now().end()); m_names.empty() || m_namesAt != at) {
        m_namesAt = at;
        m_names.clear();
        for (const Character* one : now.listed()) {
            for (std::string& name : namesOf(one->key)) {
                ++m_names[std::move(name)];
            }
        }
    }
    const auto names = namesOf(key);
    const Character* itself = now.findListed(now.current(key));
    const auto own = itself != nullptr ? namesOf(itself->key) : decltype(namesOf(key)){};
    const auto others = [&](std::size_t i) {
        const auto found = m_names.find(names[i]);
        return found == m_names.end() ? 0 : found->second - (own[i] == names[i] ? 1 : 0);
    };
    return {others(0), others(1), others(2)};
}

Colour Roster::colour(const CharacterKey& key) const {
    const auto sent = parseColour(metadataValue(key, "color").shown());
    const Character* character = find(key);
    return sent ? *sent : defaultColour(character != nullptr ? character->ordinal : 0);
}

const ForeignText& Roster::metadataValue(const CharacterKey& key, std::string_view tag) const {
    static const ForeignText none;
    const Character* character = find(key);
    const std::uint64_t end = m_moment.end();
    const ForeignText& value =
        character != nullptr && end != 0 ? character->metadata.value(tag, end - 1) : none;
    const Character* before = value.isEmpty() ? predecessor(key) : nullptr;
    return before != nullptr ? metadataValue(before->key, tag) : value;
}

const Character* Roster::predecessor(const CharacterKey& key) const {
    const Character* character = find(key);
    const Character* before = character != nullptr && character->before ? find(*character->before) : nullptr;
    return before != nullptr && before->lastPacket < character->firstPacket ? before : nullptr;
}

const Character* Roster::successor(const Character& character) const {
    const Character* next = character.after ? find(*character.after) : nullptr;
    const bool hasTakenOver =
        next != nullptr && next->firstPacket < m_moment.end() && next->firstPacket > character.lastPacket;
    return hasTakenOver ? next : nullptr;
}

bool Roster::isSuperseded(const CharacterKey& key) const {
    const Character* character = find(key);
    return character != nullptr && successor(*character) != nullptr;
}

CharacterKey Roster::current(const CharacterKey& key) const {
    CharacterKey current = key;
    for (const Character* character = find(key); character != nullptr; character = successor(*character)) {
        current = character->key;
    }
    return current;
}

std::vector<const Character*> Roster::lineage(const CharacterKey& key) const {
    std::vector<const Character*> line;
    for (const Character* one = find(key); one != nullptr; one = predecessor(one->key)) {
        line.push_back(one);
    }
    std::ranges::reverse(line);
    return line;
}

bool Roster::isSame(const CharacterKey& a, const CharacterKey& b) const {
    const Roster now(m_moment.now());
    return a == b || now.current(a) == now.current(b);
}

std::vector<const Character*> Roster::listed() const {
    using Appearing = std::pair<std::uint64_t, const Character*>;
    std::vector<Appearing> appearing;
    for (const Character& character : characters()) {
        if (findListed(character.key) != nullptr) {
            // Listed or not, the first of its line tells where it belongs.
            const Character& first = *lineage(character.key).front();
            appearing.emplace_back(first.formerFirstPacket.value_or(first.firstPacket), &character);
        }
    }
    std::ranges::stable_sort(appearing, {}, &Appearing::first);
    std::vector<const Character*> shown(appearing.size());
    std::ranges::transform(appearing, shown.begin(), &Appearing::second);
    return shown;
}

const Character* Roster::findListed(const CharacterKey& key) const {
    const Character* character = find(key);
    const Character* earlier = predecessor(key);
    const bool hasBegun = earlier == nullptr || successor(*earlier) == character;
    const bool isListed =
        character != nullptr && character->isConfirmed && hasBegun && successor(*character) == nullptr;
    return isListed ? character : nullptr;
}

bool Roster::isChosen(const std::set<CharacterKey>& chosen, const CharacterKey& key) const {
    const auto isOne = [&](const Character* one) { return chosen.contains(one->key); };
    return !chosen.empty() &&
           (chosen.contains(key) || std::ranges::any_of(lineage(Roster(m_moment.now()).current(key)), isOne));
}

bool Roster::isHidden(const CharacterKey& key) const {
    return isChosen(m_moment.choices().hidden, key);
}

bool Roster::isLifted(const CharacterKey& key) const {
    return isChosen(m_moment.choices().lifted, key);
}

bool Roster::isSelected(const CharacterKey& key) const {
    const auto& selected = m_moment.choices().selection.character;
    return selected && isSame(*selected, key);
}

} // namespace posewire::model
