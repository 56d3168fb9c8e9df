// SPDX-License-Identifier: MIT
#include "core/model/incidents/incident.h"

#include <cmath>

namespace posewire::model {
namespace {

/// A longer silence is more than a warning.
constexpr double kLongSilenceS = 1;

bool losesSamples(IncidentKind kind) {
    return kind == IncidentKind::Loss || kind == IncidentKind::Local || kind == IncidentKind::Outage;
}

void addLosses(const Incident& incident, words::Fact& fact) {
    if (incident.samples != 0 || incident.kind == IncidentKind::Loss) {
        fact.values.push_back({"missing", lostFact(incident, incident.lost(), 0)});
        fact.values.push_back({"amount", lostFact(incident, incident.lost(), 0)});
    }
    std::uint64_t gaps = incident.count;
    for (const Incident::Part& part : incident.parts) {
        gaps -= part.isSampled() ? 0 : std::min(gaps, part.count);
    }
    if (gaps != 0) {
        fact.values.push_back({"gaps", words::counted(words::Kind::Gaps, gaps)});
    }
    if (incident.cause) {
        fact.values.push_back({"cause", causeFact(*incident.cause)});
    }
    if (!incident.isCurrent) {
        fact.values.push_back(
            {"lasted", words::Number{log::secondsOf(incident.lastStamp - incident.firstStamp), 2}});
    }
    fact.values.push_back({"evidence", incident.detail});
}

/// What its value is: datagrams or packets that this computer missed, a figure and its limit, or a time.
void addValue(const Incident& incident, words::Fact& fact) {
    const IncidentKindFacts& facts = factsOf(incident.kind);
    const auto whole = static_cast<std::uint64_t>(std::max(0.0, incident.value));
    if (facts.sumsValue) {
        if (whole != 0) {
            fact.values.push_back({"dropped", words::counted(words::Kind::Datagrams, whole)});
        }
        fact.values.push_back({"packets", words::counted(words::Kind::Packets, whole)});
    } else if (facts.group == IncidentGroup::Limit) {
        fact.values.push_back({"value", words::Number{incident.value, facts.decimals}});
        fact.values.push_back({"limit", words::Number{incident.limit, facts.decimals, true}});
    } else if (incident.kind == IncidentKind::ClockSet) {
        fact.values.push_back(
            {incident.value < 0 ? "back" : "forward", words::Number{std::abs(incident.value), 3}});
    }
}

template <class Get>
auto onlyOne(const std::vector<Incident::Part>& parts, Get&& get) {
    auto first = parts.empty() ? decltype(get(parts.front()))() : get(parts.front());
    const bool isSame = std::ranges::all_of(parts, [&](const auto& part) { return get(part) == first; });
    return isSame ? first : decltype(first)();
}

template <class Get>
auto eachOnce(const std::vector<Incident::Part>& parts, Get&& get) {
    std::vector<std::decay_t<decltype(*get(parts.front()))>> values;
    for (const Incident::Part& part : parts) {
        if (const auto value = get(part)) {
            values.push_back(*value);
        }
    }
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

constexpr auto kCharacterOf = [](const Incident::Part& part) { return part.whose(); };
constexpr auto kTypeOf = [](const Incident::Part& part) { return part.type; };

} // namespace

Occurrence Occurrence::at(IncidentKind kind, log::SenderId sender, log::Stamp stamp, std::uint64_t packet) {
    Occurrence one;
    one.kind = kind;
    one.sender = sender;
    one.from = one.to = stamp;
    one.fromPacket = one.toPacket = packet;
    return one;
}

IncidentSeverity Incident::severity() const {
    const bool isLoss = kind == IncidentKind::Loss;
    const bool isGrave =
        (isLoss && limit > 0 && value > limit) ||
        (isLoss && std::ranges::any_of(parts, [](const Part& part) { return part.lastMany.has_value(); })) ||
        (kind == IncidentKind::Outage && value >= kLongSilenceS) ||
        (kind == IncidentKind::Content && factsOf(what).isGrave);
    return isGrave ? IncidentSeverity::Error : factsOf(kind).severity;
}

IncidentGroup Incident::group() const {
    return factsOf(kind).group;
}

bool Incident::lasts() const {
    return factsOf(kind).lasts && factsOf(what).lasts;
}

std::string_view nameOf(IncidentKind kind) {
    return factsOf(kind).name;
}

words::Fact lostFact(const Incident& incident, std::uint64_t samples, std::uint64_t expected) {
    constexpr std::uint64_t kFew = 10;
    const bool isOfMessages = incident.isOfMessages();
    const double percent =
        100.0 * static_cast<double>(samples) / static_cast<double>(std::max<std::uint64_t>(1, expected));
    const bool isShare = samples > kFew && expected > 10 * kFew && percent <= 100 && !isOfMessages;
    words::Fact amount =
        isShare ? words::Fact{words::Kind::Share, {{"n", words::Number{percent, percent < 10 ? 1 : 0}}}}
                : words::counted(isOfMessages ? words::Kind::Messages : words::Kind::Samples, samples);
    return {isOfMessages ? words::Kind::Incomplete : words::Kind::Lost, {{"n", std::move(amount)}}};
}

words::Fact causeFact(LossCause cause) {
    using enum words::Kind;
    constexpr std::array<words::Kind, kLossCauses> kKinds{CauseThisComputer, CauseNetwork, CauseSender,
                                                          CauseUnknown, CauseTransport};
    return {kKinds[static_cast<std::size_t>(cause)]};
}

std::optional<CharacterKey> Incident::character() const {
    return onlyOne(parts, kCharacterOf);
}

std::optional<std::uint8_t> Incident::type() const {
    return onlyOne(parts, kTypeOf);
}

bool Incident::isOfMessages() const {
    return !parts.empty() && std::ranges::none_of(parts, &Part::isSampled);
}

std::uint64_t Incident::lost() const {
    std::uint64_t messages = 0;
    for (const Part& part : parts) {
        messages += part.isSampled() ? 0 : part.samples;
    }
    return messages < samples ? samples - messages : samples;
}

std::vector<CharacterKey> Incident::characters() const {
    return eachOnce(parts, kCharacterOf);
}

std::vector<std::uint8_t> Incident::types() const {
    return eachOnce(parts, kTypeOf);
}

Incident Incident::of(std::span<const CharacterKey> which) const {
    return without([which](const Part& part) {
        return part.character && std::ranges::count(which, *part.whose()) == 0;
    });
}

Incident Incident::without(const std::function<bool(const Part&)>& isLeftOut) const {
    Incident own = *this;
    std::erase_if(own.parts, isLeftOut);
    const bool isShared =
        std::ranges::any_of(parts, [](const Part& part) { return part.character.has_value(); });
    if (isShared && !own.parts.empty()) {
        own.samples = own.count = 0;
        for (const Part& part : own.parts) {
            own.samples += part.samples;
            own.count += part.count;
        }
        own.times = std::ranges::max(own.parts, {}, &Part::times).times;
        own.firstStamp = std::ranges::min(own.parts, {}, &Part::from).from;
        own.lastStamp = std::ranges::max(own.parts, {}, &Part::to).to;
        own.isCurrent = isCurrent && std::ranges::any_of(own.parts, &Part::isCurrent);
    }
    return own;
}

bool Incident::concerns(const CharacterKey& which) const {
    return std::ranges::any_of(parts, [&](const Part& part) {
        return part.whose().value_or(which) == which && (part.isCurrent || !isCurrent);
    });
}

bool Incident::concerns(const log::StreamKey& which) const {
    const CharacterKey character{which.sender, which.character};
    return std::ranges::any_of(parts, [&](const Part& part) {
        return part.whose().value_or(character) == character &&
               part.type.value_or(which.type) == which.type && (part.isCurrent || !isCurrent);
    });
}

words::Fact Incident::fact() const {
    const words::Kind says = factsOf(kind).says;
    const bool isLoss = losesSamples(kind);
    words::Fact fact = isLoss || detail.isNothing() ? words::Fact{says} : detail;
    if (isLoss) {
        addLosses(*this, fact);
    }
    // An outage of several silences, in which nothing was lost.
    if (kind == IncidentKind::Outage && samples == 0 && value < kLongSilenceS &&
        std::ranges::any_of(parts, [](const Part& part) { return part.count >= 3; })) {
        fact = {words::Kind::InBursts, {{"value", words::Number{value, 1}}}};
    }
    addValue(*this, fact);
    fact.values.push_back({"count", words::counted(words::Kind::Datagrams, count)});
    return fact;
}

words::Fact Incident::fact(const Part& part) const {
    words::Fact fact = of(part).fact();
    fact.kind = losesSamples(kind) && part.samples != 0 ? words::Kind::Loss : fact.kind;
    return fact;
}

Incident Incident::of(const Part& part) const {
    Incident own = *this;
    own.parts = {part};
    own.firstStamp = part.from;
    own.lastStamp = part.to;
    own.count = part.count;
    own.samples = part.samples;
    own.isCurrent = isCurrent && part.isCurrent;
    if (kind == IncidentKind::Outage && part.samples == 0) {
        own.cause.reset();
    }
    return own;
}

} // namespace posewire::model
