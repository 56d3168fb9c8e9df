// SPDX-License-Identifier: MIT
#include "core/model/session/session_view.h"

#include <algorithm>

/// What the view counts and names; messages and poses are in session_messages.cpp.
namespace posewire::model {

StreamCounts SessionView::countsOf(const CharacterKey& key, const TimeRange& range) const {
    StreamCounts sum;
    for (const Stream& stream : streams()) {
        if (CharacterKey{stream.key.sender, stream.key.character} == key) {
            sum += stream.accounting.countsBetween(range.from, range.to);
        }
    }
    return sum;
}

std::uint64_t SessionView::packetFrom(log::Stamp stamp) const {
    std::uint64_t first = begin();
    std::uint64_t last = end();
    while (first < last) {
        const std::uint64_t middle = first + (last - first) / 2;
        const auto packet = this->packet(middle);
        if (packet && packet->stamp >= stamp) {
            last = middle;
        } else {
            first = middle + 1;
        }
    }
    return first;
}

std::uint64_t SessionView::packetAt(log::Stamp stamp) const {
    const std::uint64_t after = packetFrom(stamp + log::Duration(1));
    return after == begin() ? after : after - 1;
}

std::optional<TimeRange> SessionView::range() const {
    if (rangeChoice().fixed || rangeChoice().last <= log::Duration::zero()) {
        return rangeChoice().fixed;
    }
    // What arrives at this very moment belongs to it.
    const log::Stamp end = cursorStamp() + log::Duration(1);
    return TimeRange{end - rangeChoice().last, end};
}

log::Stamp SessionView::cursorStamp() const {
    if (!isPaused()) {
        return now();
    }
    const auto packet = this->packet(cursor().packet);
    return packet ? packet->stamp : now();
}

std::uint64_t SessionView::visibleEnd() const {
    return isPaused() ? std::min(end(), cursor().packet + 1) : end();
}

std::optional<log::Stamp> SessionView::pausedStamp() const {
    return isPaused() ? std::optional(cursorStamp()) : std::nullopt;
}

std::vector<const Event*> SessionView::troublesOf(const CharacterKey& key) const {
    return m_ingest.follower().troublesOf(key, pausedStamp());
}

Condition SessionView::conditionOf(const CharacterKey& key) const {
    if (isSuperseded(key)) {
        return {};
    }
    const Condition condition = m_ingest.follower().conditionOf(key, pausedStamp());
    if (condition.level != Condition::Level::Good) {
        return condition;
    }
    const double age = ageSeconds(key);
    if (age >= Condition::kStaleS) {
        return {Condition::Level::Error, "No data for 1 s.", {}};
    }
    if (age >= Condition::kSilentS) {
        return {Condition::Level::Warning, "No data for 0.25 s.", {}};
    }
    const Sender* sender = find(key.sender);
    const auto contradictions = sender != nullptr ? sender->contradictions() : std::vector<Contradiction>();
    return contradictions.empty() ? condition
                                  : Condition{Condition::Level::Warning, contradictions.front().text, {}};
}

const Character* SessionView::predecessor(const CharacterKey& key) const {
    const Character* character = find(key);
    const Character* before = character != nullptr && character->before ? find(*character->before) : nullptr;
    return before != nullptr && before->lastPacket < character->firstPacket ? before : nullptr;
}

CharacterKey SessionView::current(const CharacterKey& key) const {
    const std::uint64_t end = visibleEnd();
    CharacterKey current = key;
    for (const Character* character = find(key); character != nullptr && character->after;) {
        const Character* next = find(*character->after);
        if (next->firstPacket >= end || next->firstPacket <= character->lastPacket) {
            break;
        }
        current = next->key;
        character = next;
    }
    return current;
}

std::vector<const Character*> SessionView::currentCharacters() const {
    std::vector<const Character*> shown;
    for (const Character& character : characters()) {
        if (!isSuperseded(character.key)) {
            shown.push_back(&character);
        }
    }
    return shown;
}

const Metadata& SessionView::metadata(const CharacterKey& key) const {
    const Character* character = find(key);
    for (const Character* other = character; other != nullptr; other = predecessor(other->key)) {
        if (!other->metadata.tags().empty()) {
            return other->metadata;
        }
    }
    return character->metadata;
}

std::string_view SessionView::metadataValue(const CharacterKey& key, std::string_view tag) const {
    const Character* character = find(key);
    const std::uint64_t end = visibleEnd();
    const std::string_view value =
        character != nullptr && end != 0 ? character->metadata.value(tag, end - 1) : std::string_view();
    const Character* before = value.empty() ? predecessor(key) : nullptr;
    return before != nullptr ? metadataValue(before->key, tag) : value;
}

std::string SessionView::displayName(const CharacterKey& key) const {
    const std::string_view name = metadataValue(key, "name");
    return name.empty() ? "Character " + std::to_string(key.character) : std::string(name);
}

Colour SessionView::colour(const CharacterKey& key) const {
    const auto sent = parseColour(metadataValue(key, "color"));
    const Character* character = find(key);
    return sent ? *sent : defaultColour(character != nullptr ? character->ordinal : 0);
}

double SessionView::ageSeconds(const CharacterKey& key) const {
    const Character* character = find(key);
    if (character == nullptr) {
        return 0;
    }
    log::Stamp newest = character->lastStamp;
    if (isPaused()) {
        newest = {};
        for (const Stream& stream : streams()) {
            const bool isOwn = stream.key.sender == key.sender && stream.key.character == key.character;
            const log::StreamEntries* list = isOwn ? m_ingest.index().find(stream.key) : nullptr;
            const std::size_t count = list != nullptr ? visibleCount(*list) : 0;
            newest = count != 0 ? std::max(newest, (*list)[count - 1].stamp) : newest;
        }
    }
    return std::max(0.0, log::secondsOf(cursorStamp() - newest));
}

} // namespace posewire::model
