// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/stream_state.h"

#include "app/gui/models/incident_words.h"
#include "app/gui/models/text.h"
#include "app/gui/theme/words.h"
#include "core/wire/type_table.h"

#include <algorithm>

namespace posewire::gui {

namespace {

/// What the time without data says; nothing before a stream is silent. Slow streams are given the time of two
/// and a half samples.
PropertyValue ageState(double age, double rateHz) {
    const double patience = rateHz > 0 ? 2.5 / rateHz : 0.0;
    if (age >= std::max(kStaleAge, patience)) {
        return {tr("stale %1").arg(duration(age)), Health::Error};
    }
    if (age >= std::max(kSilentAge, patience)) {
        return {tr("silent %1").arg(duration(age)), Health::Warning};
    }
    return {};
}

PropertyValue malformedState(std::uint64_t count) {
    return {tr("%1 malformed").arg(grouped(count)), Health::Error};
}

/// Another sender has taken over: nothing is wrong, and nothing more will come.
PropertyValue ended() {
    return {tr("ended")};
}

/// What is missing of one sample is missing in each of its types: the worst stream counts.
std::uint64_t lostOf(const model::Character& character) {
    std::uint64_t lost = 0;
    for (const model::Stream* stream : character.streams) {
        lost = std::max(lost, stream->accounting.counts().lost);
    }
    return lost;
}

/// What does not fit together about a sender, in brief; empty where all does.
QString contradictionOf(const model::Sender* sender) {
    const auto found = sender != nullptr ? sender->contradictions() : std::vector<model::Contradiction>();
    return found.empty() ? QString() : QString::fromStdString(found.front().brief);
}

bool hasEnded(model::SessionView& view, const model::Sender& sender) {
    return sender.isPerforming() && std::ranges::all_of(sender.characters, [&](const auto* character) {
               return view.isSuperseded(character->key);
           });
}

/// Seconds; at least 0, also when the cursor lies before it.
double ageOf(model::SessionView& view, log::Stamp stamp) {
    return std::max(0.0, log::secondsOf(view.cursorStamp() - stamp));
}

} // namespace

PropertyValue streamState(model::SessionView& view, const model::Stream& stream) {
    if (view.isSuperseded({stream.key.sender, stream.key.character})) {
        return ended();
    }
    if (wire::isSampled(stream.key.type)) {
        const double age = ageOf(view, stream.accounting.lastStamp());
        const PropertyValue state = ageState(age, stream.statistics.rateHz());
        if (state.health != Health::Unknown) {
            return state;
        }
    }
    if (const std::uint64_t malformed = stream.accounting.malformed(); malformed != 0) {
        return malformedState(malformed);
    }
    const std::uint64_t lost = stream.accounting.counts().lost;
    return {grouped(lost), lost == 0 ? Health::Good : Health::Warning};
}

PropertyValue characterState(model::SessionView& view, const model::Character& character) {
    if (view.isSuperseded(character.key)) {
        return ended();
    }
    const model::Condition condition = view.conditionOf(character.key);
    if (condition.level == model::Condition::Level::Good) {
        return {grouped(lostOf(character)), Health::Good};
    }
    const Health health = condition.level == model::Condition::Level::Error ? Health::Error : Health::Warning;
    const double age = view.ageSeconds(character.key);
    if (age >= kSilentAge) {
        return {(age >= kStaleAge ? tr("stale %1") : tr("silent %1")).arg(duration(age)), health};
    }
    if (const model::Incident* event =
            condition.incident ? view.incidents().find(*condition.incident) : nullptr) {
        return {briefWords(event->of(character.key.character)), health};
    }
    return {contradictionOf(view.find(character.key.sender)), health};
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
        return malformedState(sender.malformed);
    }
    if (sender.foreign != 0) {
        return {tr("%1 foreign").arg(grouped(sender.foreign)), Health::Warning};
    }
    const QString contradiction = contradictionOf(&sender);
    return {contradiction, contradiction.isEmpty() ? Health::Unknown : Health::Warning};
}

bool isLive(model::SessionView& view, const model::Character& character) {
    return view.ageSeconds(character.key) < kStaleAge;
}

} // namespace posewire::gui
