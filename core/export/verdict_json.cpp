// SPDX-License-Identifier: MIT
#include "core/export/verdict_json.h"

#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"
#include "core/wire/type_table.h"
#include "core/words/say.h"

#include <functional>
#include <utility>

namespace posewire::exporting {
namespace {

JsonValue timeJson(const model::SessionView& session, log::Stamp stamp) {
    return log::nanosecondsOf(session.wallOf(stamp));
}

template <class Number, class ToJson>
JsonValue numberList(const std::vector<Number>& values, ToJson toJson) {
    JsonValue::List list;
    for (const Number value : values) {
        list.push_back(toJson(value));
    }
    return list;
}

JsonValue causeJson(const std::optional<model::LossCause>& cause) {
    if (!cause) {
        return {};
    }
    constexpr std::array<std::string_view, model::kLossCauses> kNames{"thisComputer", "network", "sender",
                                                                      "unknown"};
    return kNames[static_cast<std::size_t>(*cause)];
}

JsonValue characterJson(const model::SessionView& session, const model::CharacterKey& key,
                        const model::TakeVerdict& verdict) {
    const model::Incident* incident =
        verdict.incident ? session.verdicts().incidents().find(*verdict.incident) : nullptr;
    return {{"source", std::string(session.roster().addressOf(key.sender).exact())},
            {"id", key.character},
            {"name", std::string(session.roster().displayName(key).exact())},
            {"state", model::nameOf(verdict.state)},
            {"cause", incident != nullptr ? causeJson(incident->cause) : JsonValue()}};
}

} // namespace

JsonValue verdictJson(const model::SessionView& session, const model::TakeVerdict& verdict) {
    const bool isNone = verdict.state == model::TakeVerdict::State::None;
    return {{"state", model::nameOf(verdict.state)},
            {"text", say(verdict.said, words::Form::Headline)},
            {"sinceNs", isNone ? JsonValue() : timeJson(session, verdict.since)}};
}

JsonValue incidentJson(const model::SessionView& session, const model::ListedIncident& listed) {
    const model::Incident& incident = listed.incident;
    const bool isOver = listed.state == model::ListedIncident::State::Over;
    const words::Fact fact = factOf(session, listed);
    return {{"id", incident.number},
            {"kind", model::wordOf(incident.kind)},
            {"cause", causeJson(incident.cause)},
            {"state", model::nameOf(listed.state)},
            {"beginNs", timeJson(session, incident.firstStamp)},
            {"endNs", isOver ? timeJson(session, incident.lastStamp) : JsonValue()},
            {"source", incident.sender == log::kNoSender
                           ? JsonValue()
                           : JsonValue(std::string(session.roster().addressOf(incident.sender).exact()))},
            {"characters", numberList(incident.characters(), [](std::uint8_t id) { return JsonValue(id); })},
            {"types", numberList(incident.types(),
                                 [](std::uint8_t type) { return JsonValue(wire::typeDigits(type)); })},
            {"samples", incident.samples},
            {"count", incident.count},
            {"text", say(fact, words::Form::Headline)},
            {"evidence", say(fact, words::Form::Sentence)}};
}

JsonValue incidentsJson(const model::SessionView& session) {
    JsonValue::List list;
    for (const model::ListedIncident& listed : model::listedIncidents(session)) {
        list.push_back(incidentJson(session, listed));
    }
    return list;
}

std::optional<std::string> VerdictLines::lineAt(const model::SessionView& session, log::Stamp now) {
    const model::TakeVerdict verdict = model::verdictOf(session, model::recentSpan(session));
    return isDue(verdict, now) ? std::optional(line(session, now, verdict, changesOf(session)))
                               : std::nullopt;
}

bool VerdictLines::skipLine(const model::SessionView& session, log::Stamp now) {
    const model::TakeVerdict verdict = model::verdictOf(session, model::recentSpan(session));
    const bool wasDue = isDue(verdict, now);
    if (wasDue) {
        await(verdict, now);
    }
    return wasDue;
}

std::optional<std::string> VerdictLines::lastLine(const model::SessionView& session, log::Stamp now) {
    const model::TakeVerdict verdict = model::verdictOf(session, model::recentSpan(session));
    const Changes changes = changesOf(session);
    const bool isTold =
        m_newest == now && changes.changed.empty() && changes.gone.empty() && sayTheSame(verdict, m_verdict);
    return isTold ? std::nullopt : std::optional(line(session, now, verdict, changes));
}

bool VerdictLines::isDue(const model::TakeVerdict& verdict, log::Stamp now) const {
    return !m_next || now >= *m_next || !sayTheSame(verdict, m_verdict);
}

/// The next line.
void VerdictLines::await(const model::TakeVerdict& verdict, log::Stamp now) {
    if (!m_next || now >= *m_next) {
        m_next = std::max(m_next.value_or(now) + m_interval, now);
    }
    m_verdict = verdict;
}

std::string VerdictLines::line(const model::SessionView& session, log::Stamp now,
                               const model::TakeVerdict& verdict, const Changes& changes) {
    await(verdict, now);
    m_newest = now;
    JsonValue::List characters;
    const std::vector<const model::Character*> listed = session.atNow().roster().listed();
    const model::TakeVerdicts verdicts = model::verdictsOf(session, model::recentSpan(session), listed);
    for (const model::Character* character : listed) {
        characters.push_back(characterJson(session, character->key, verdicts.characters.at(character->key)));
    }
    JsonValue object{{"timeNs", timeJson(session, now)},
                     {"verdict", verdictJson(session, verdict)},
                     {"characters", std::move(characters)},
                     {"incidents", changes.changed}};
    if (!changes.gone.empty()) {
        object["gone"] = numberList(changes.gone, [](std::uint64_t number) { return JsonValue(number); });
    }
    return object.text();
}

VerdictLines::Changes VerdictLines::changesOf(const model::SessionView& session) {
    Changes changes;
    std::map<std::uint64_t, std::uint64_t> told;
    for (const model::ListedIncident& listed : model::listedIncidents(session)) {
        JsonValue json = incidentJson(session, listed);
        const std::uint64_t sum = std::hash<std::string>{}(json.text());
        const auto before = m_told.find(listed.incident.number);
        if (before == m_told.end() || before->second != sum) {
            changes.changed.push_back(std::move(json));
        }
        told[listed.incident.number] = sum;
    }
    for (const auto& [number, sum] : m_told) {
        if (!told.contains(number)) {
            changes.gone.push_back(number);
        }
    }
    m_told = std::move(told);
    return changes;
}

} // namespace posewire::exporting
