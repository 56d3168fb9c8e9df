// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/stream_state.h"

#include "app/gui/models/event_words.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/wire/type_table.h"

#include <algorithm>

namespace posewire::gui {

namespace {

PropertyValue silent(double age) {
    return {tr("silent %1").arg(duration(age)), Health::Warning};
}

PropertyValue stale(double age) {
    return {tr("stale %1").arg(duration(age)), Health::Error};
}

/// Slow streams are given the time of two and a half samples before they are silent.
PropertyValue ageState(double age, double rateHz) {
    const double patience = rateHz > 0 ? 2.5 / rateHz : 0.0;
    if (age >= std::max(kStaleAge, patience)) {
        return stale(age);
    }
    if (age >= std::max(kSilentAge, patience)) {
        return silent(age);
    }
    return {};
}

PropertyValue countState(std::uint64_t malformed, std::uint64_t lost) {
    if (malformed != 0) {
        return {tr("%1 malformed").arg(grouped(malformed)), Health::Error};
    }
    return {grouped(lost), lost == 0 ? Health::Good : Health::Warning};
}

/// Another sender has taken over: nothing is wrong, and nothing more will come.
PropertyValue ended() {
    return {tr("ended"), Health::Unknown};
}

/// What is missing of one sample is missing in each of its types: the worst stream counts.
std::uint64_t lostOf(model::SessionView& view, const model::CharacterKey& key) {
    std::uint64_t lost = 0;
    for (const model::Stream& stream : view.streams()) {
        if (stream.key.sender == key.sender && stream.key.character == key.character) {
            lost = std::max(lost, stream.accounting.counts().lost);
        }
    }
    return lost;
}

/// What does not fit together about the sender, in brief; empty where all does.
QString contradictionOf(model::SessionView& view, const model::CharacterKey& key) {
    const model::Sender* sender = view.find(key.sender);
    const auto found = sender != nullptr ? sender->contradictions() : std::vector<model::Contradiction>();
    return found.empty() ? QString() : QString::fromStdString(found.front().brief);
}

bool hasEnded(model::SessionView& view, const model::Sender& sender) {
    bool hasCharacters = false;
    for (const model::Character& character : view.characters()) {
        if (character.key.sender == sender.id) {
            hasCharacters = true;
            if (!view.isSuperseded(character.key)) {
                return false;
            }
        }
    }
    return hasCharacters;
}

double ageOf(model::SessionView& view, log::Stamp stamp) {
    return std::max(0.0, log::secondsOf(view.cursorStamp() - stamp));
}

} // namespace

double streamAge(model::SessionView& view, const model::Stream& stream) {
    return ageOf(view, stream.accounting.lastStamp());
}

PropertyValue streamState(model::SessionView& view, const model::Stream& stream) {
    if (view.isSuperseded({stream.key.sender, stream.key.character})) {
        return ended();
    }
    if (wire::isSampled(stream.key.type)) {
        const PropertyValue age = ageState(streamAge(view, stream), stream.statistics.rateHz());
        if (age.health != Health::Unknown) {
            return age;
        }
    }
    return countState(stream.accounting.malformed(), stream.accounting.counts().lost);
}

PropertyValue characterState(model::SessionView& view, const model::Character& character) {
    if (view.isSuperseded(character.key)) {
        return ended();
    }
    const model::Condition condition = view.conditionOf(character.key);
    if (condition.level == model::Condition::Level::Good) {
        return {grouped(lostOf(view, character.key)), Health::Good};
    }
    const Health health = condition.level == model::Condition::Level::Error ? Health::Error : Health::Warning;
    const double age = view.ageSeconds(character.key);
    if (age >= kSilentAge) {
        return {(age >= kStaleAge ? tr("stale %1") : tr("silent %1")).arg(duration(age)), health};
    }
    if (const model::Event* event = condition.event ? view.events().find(*condition.event) : nullptr) {
        return {briefWords(*event), health};
    }
    return {contradictionOf(view, character.key), health};
}

PropertyValue senderState(model::SessionView& view, const model::Sender& sender) {
    if (hasEnded(view, sender)) {
        return ended();
    }
    const PropertyValue age = ageState(ageOf(view, sender.lastStamp), 0.0);
    if (age.health != Health::Unknown) {
        return age;
    }
    if (sender.kernelDrops != 0) {
        return {tr("%1 dropped here").arg(grouped(sender.kernelDrops)), Health::Error};
    }
    if (sender.malformed != 0) {
        return {tr("%1 malformed").arg(grouped(sender.malformed)), Health::Error};
    }
    if (sender.foreign != 0) {
        return {tr("%1 foreign").arg(grouped(sender.foreign)), Health::Warning};
    }
    if (const auto found = sender.contradictions(); !found.empty()) {
        return {QString::fromStdString(found.front().brief), Health::Warning};
    }
    return {};
}

bool isLive(model::SessionView& view, const model::Character& character) {
    return view.ageSeconds(character.key) < kStaleAge;
}

} // namespace posewire::gui
