// SPDX-License-Identifier: MIT
#include "core/model/incidents/incident.h"

#include "core/model/incidents/incident_kinds.h"
#include "core/model/text.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <cmath>

namespace posewire::model {
namespace {

/// A longer silence is more than a warning.
constexpr double kLongSilenceS = 1;

std::uint64_t wholeOf(double value) {
    return static_cast<std::uint64_t>(std::max(0.0, value));
}

std::string causeText(const Incident& incident) {
    return incident.cause ? ", cause: " + std::string(nameOf(*incident.cause)) : std::string();
}

std::string withDetail(std::string text, const Incident& incident) {
    return incident.detail.empty() ? text : std::move(text) + ' ' + incident.detail;
}

/// "12 samples lost".
std::string missingText(const Incident& incident, std::uint64_t count) {
    return counted(count, incident.noun()) + ' ' + std::string(incident.fate());
}

std::string lossText(const Incident& incident) {
    const std::string gaps = incident.isOfMessages() ? "" : " in " + counted(incident.count, "gap");
    return withDetail(missingText(incident, incident.samples) + gaps + causeText(incident) + '.', incident);
}

std::string localText(const Incident& incident) {
    const std::uint64_t dropped = wholeOf(incident.value);
    std::string text = dropped != 0 ? "This computer dropped " + counted(dropped, "datagram")
                                    : "This computer did not look at everything in time";
    text += incident.samples != 0 ? ": " + missingText(incident, incident.samples) + '.' : ".";
    return withDetail(std::move(text), incident);
}

std::string outageText(const Incident& incident) {
    if (incident.isCurrent) {
        return "No data.";
    }
    std::string text =
        "No data for " + fixedText(log::secondsOf(incident.lastStamp - incident.firstStamp), 2) + " s";
    if (incident.samples != 0) {
        text += ": " + counted(incident.samples, "sample") + " lost";
    }
    return withDetail(text + causeText(incident) + '.', incident);
}

std::string limitText(const Incident& incident, const char* what, const char* unit, int decimals) {
    std::string limit = fixedText(incident.limit, decimals); // as somebody set it: "10", not "10.0"
    if (limit.find('.') != std::string::npos) {
        limit.erase(limit.find_last_not_of('0') + 1);
        limit.erase(limit.find_last_not_of('.') + 1);
    }
    return std::string(what) + ' ' + fixedText(incident.value, decimals) + ' ' + unit + ", limit " + limit +
           ' ' + unit + '.';
}

template <class Get>
auto onlyOne(const std::vector<Incident::Part>& parts, Get&& get) {
    auto first = parts.empty() ? decltype(get(parts.front()))() : get(parts.front());
    const bool isSame = std::ranges::all_of(parts, [&](const auto& part) { return get(part) == first; });
    return isSame ? first : decltype(first)();
}

template <class Get>
std::vector<std::uint8_t> eachOnce(const std::vector<Incident::Part>& parts, Get&& get) {
    std::vector<std::uint8_t> values;
    for (const Incident::Part& part : parts) {
        if (const auto value = get(part)) {
            values.push_back(*value);
        }
    }
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

constexpr auto kCharacterOf = [](const Incident::Part& part) { return part.character; };
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
        (kind == IncidentKind::Outage && value >= kLongSilenceS);
    return isGrave ? IncidentSeverity::Error : factsOf(kind).severity;
}

IncidentGroup Incident::group() const {
    return factsOf(kind).group;
}

std::string_view nameOf(IncidentKind kind) {
    return factsOf(kind).name;
}

std::string_view wordOf(IncidentKind kind) {
    return factsOf(kind).word;
}

std::string typesText(const std::vector<std::uint8_t>& types) {
    std::vector<std::string> names;
    for (const std::uint8_t type : types) {
        names.push_back(wire::typeDigits(type));
    }
    return (types.size() == 1 ? "type " : "types ") + listed(names);
}

std::optional<std::uint8_t> Incident::character() const {
    return onlyOne(parts, kCharacterOf);
}

std::optional<std::uint8_t> Incident::type() const {
    return onlyOne(parts, kTypeOf);
}

bool Incident::isOfMessages() const {
    return !parts.empty() && std::ranges::all_of(parts, [](const Part& part) {
        return part.type && !countsSamples(*part.type);
    });
}

std::vector<std::uint8_t> Incident::characters() const {
    return eachOnce(parts, kCharacterOf);
}

std::vector<std::uint8_t> Incident::types() const {
    return eachOnce(parts, kTypeOf);
}

Incident Incident::of(std::span<const std::uint8_t> which) const {
    Incident own = *this;
    std::erase_if(own.parts, [which](const Part& part) {
        return part.character && std::ranges::count(which, *part.character) == 0;
    });
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

bool Incident::concerns(std::uint8_t which) const {
    return std::ranges::any_of(parts, [&](const Part& part) {
        return part.character.value_or(which) == which && (part.isCurrent || !isCurrent);
    });
}

bool Incident::concerns(std::uint8_t which, std::uint8_t whichType) const {
    return std::ranges::any_of(parts, [&](const Part& part) {
        return part.character.value_or(which) == which && part.type.value_or(whichType) == whichType &&
               (part.isCurrent || !isCurrent);
    });
}

std::string Incident::text() const {
    switch (kind) {
    case IncidentKind::SourceUp:
        return "A sender started sending.";
    case IncidentKind::Loss:
        return lossText(*this);
    case IncidentKind::Local:
        return localText(*this);
    case IncidentKind::Outage:
        return outageText(*this);
    case IncidentKind::Reordered:
        return counted(count, "datagram") + " came after a later one.";
    case IncidentKind::Duplicates:
        return counted(count, "datagram") + " came more than once.";
    case IncidentKind::Malformed:
        return counted(count, "datagram") + " could not be decoded.";
    case IncidentKind::Foreign:
        return counted(count, "datagram is", "datagrams are") + " not MXTP.";
    case IncidentKind::Restart:
        return detail.empty() ? "The sample counter restarted." : detail;
    case IncidentKind::Overtaken:
        return "This computer did not look at " + counted(wholeOf(value), "packet") + " in time.";
    case IncidentKind::Step:
    case IncidentKind::Scale:
    case IncidentKind::MetadataChange:
    case IncidentKind::RelayLoop:
    case IncidentKind::RecordingEnded:
        return detail;
    case IncidentKind::ScaleChange:
        return "The null pose changed.";
    case IncidentKind::TimeCode:
        return !detail.empty() ? detail : "The time code jumped by " + fixedText(value, 0) + " ms.";
    case IncidentKind::Conflict:
        return "Character " + std::to_string(character().value_or(0)) +
               " comes from elsewhere at the same time: " + detail + '.';
    case IncidentKind::ClockSet:
        return std::string("The receiving computer's clock was set ") + (value < 0 ? "back" : "forward") +
               " by " + fixedText(std::abs(value), 3) + " s.";
    case IncidentKind::LossLimit:
        return limitText(*this, "Loss", "%", 2);
    case IncidentKind::JitterLimit:
        return limitText(*this, "Jitter", "ms", 1);
    case IncidentKind::GapLimit:
        return limitText(*this, "Gap", "ms", 0);
    case IncidentKind::AgeLimit:
        return limitText(*this, "Age", "s", 1);
    case IncidentKind::RateLimit:
        return limitText(*this, "Rate off by", "%", 1);
    }
    return {};
}

std::string Incident::text(const Part& part) const {
    Incident own = *this;
    own.parts = {part};
    own.firstStamp = part.from;
    own.lastStamp = part.to;
    own.count = part.count;
    own.samples = part.samples;
    own.isCurrent = isCurrent && part.isCurrent;
    const bool isSilence = kind == IncidentKind::Outage && part.samples == 0;
    if (isSilence) {
        own.cause.reset();
    }
    const bool isLoss =
        kind == IncidentKind::Loss || kind == IncidentKind::Local || kind == IncidentKind::Outage;
    std::string text = isLoss && !isSilence ? missingText(own, part.samples) : own.text();
    if (isLoss && part.count != 0 && kind != IncidentKind::Outage && !own.isOfMessages()) {
        text += ", " + counted(part.count, "gap");
    }
    text.erase(text.find_last_not_of('.') + 1);
    return text;
}

} // namespace posewire::model
