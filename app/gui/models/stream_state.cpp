// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/stream_state.h"

#include "app/gui/models/event_words.h"
#include "app/gui/models/text.h"
#include "core/wire/type_table.h"

#include <QCoreApplication>

#include <algorithm>

namespace posewire::gui {

namespace {

QString tr(const char* text) {
    return QCoreApplication::translate("StreamState", text);
}

State silent(double age) {
    return {Health::Warning, tr("silent %1").arg(duration(age))};
}

State stale(double age) {
    return {Health::Error, tr("stale %1").arg(duration(age))};
}

/// Slow streams are given the time of two and a half samples before they are silent.
State ageState(double age, double rateHz) {
    const double patience = rateHz > 0 ? 2.5 / rateHz : 0.0;
    if (age >= std::max(kStaleAge, patience)) {
        return stale(age);
    }
    if (age >= std::max(kSilentAge, patience)) {
        return silent(age);
    }
    return {};
}

State countState(std::uint64_t malformed, std::uint64_t lost) {
    if (malformed != 0) {
        return {Health::Error, tr("%1 malformed").arg(grouped(malformed))};
    }
    return {lost == 0 ? Health::Good : Health::Warning, grouped(lost)};
}

/// Another sender has taken over: nothing is wrong, and nothing more will come.
State ended() {
    return {Health::Unknown, tr("ended")};
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

double ageOf(model::SessionView& view, std::int64_t stampNs) {
    return std::max(0.0, static_cast<double>(view.cursorStampNs() - stampNs) * 1e-9);
}

} // namespace

QString State::display() const {
    return health == Health::Unknown ? text : healthSymbol(health) + QLatin1Char(' ') + text;
}

double streamAge(model::SessionView& view, const model::Stream& stream) {
    return ageOf(view, stream.accounting.lastStampNs());
}

State streamState(model::SessionView& view, const model::Stream& stream) {
    if (view.isSuperseded({stream.key.sender, stream.key.character})) {
        return ended();
    }
    if (wire::isSampled(stream.key.type)) {
        const State age = ageState(streamAge(view, stream), stream.statistics.rateHz());
        if (age.health != Health::Unknown) {
            return age;
        }
    }
    return countState(stream.accounting.malformed(), stream.accounting.counts().lost);
}

State characterState(model::SessionView& view, const model::Character& character) {
    if (view.isSuperseded(character.key)) {
        return ended();
    }
    const model::Condition condition = view.conditionOf(character.key);
    if (condition.level == model::Condition::Level::Good) {
        return {Health::Good, grouped(lostOf(view, character.key))};
    }
    const Health health = condition.level == model::Condition::Level::Error ? Health::Error : Health::Warning;
    const double age = view.ageSeconds(character.key);
    if (age >= kSilentAge) {
        return {health, (age >= kStaleAge ? tr("stale %1") : tr("silent %1")).arg(duration(age))};
    }
    if (const model::Event* event = condition.event ? view.events().find(*condition.event) : nullptr) {
        return {health, briefWords(*event)};
    }
    return {health, contradictionOf(view, character.key)};
}

State senderState(model::SessionView& view, const model::Sender& sender) {
    if (hasEnded(view, sender)) {
        return ended();
    }
    const State age = ageState(ageOf(view, sender.lastStampNs), 0.0);
    if (age.health != Health::Unknown) {
        return age;
    }
    if (sender.kernelDrops != 0) {
        return {Health::Error, tr("%1 dropped here").arg(grouped(sender.kernelDrops))};
    }
    if (sender.malformed != 0) {
        return {Health::Error, tr("%1 malformed").arg(grouped(sender.malformed))};
    }
    if (sender.foreign != 0) {
        return {Health::Warning, tr("%1 foreign").arg(grouped(sender.foreign))};
    }
    if (const auto found = sender.contradictions(); !found.empty()) {
        return {Health::Warning, QString::fromStdString(found.front().brief)};
    }
    return {};
}

bool isLive(model::SessionView& view, const model::Character& character) {
    return view.ageSeconds(character.key) < kStaleAge;
}

} // namespace posewire::gui
