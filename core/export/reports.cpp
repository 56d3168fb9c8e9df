// SPDX-License-Identifier: MIT
#include "core/export/reports.h"

#include "core/export/html.h"
#include "core/export/json_value.h"
#include "core/model/session/accounts.h"
#include "core/model/session/memory_figures.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "core/wire/type_table.h"
#include "core/words/say.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace posewire::exporting {
namespace {

JsonValue timeJson(const model::SessionView& session, log::Stamp stamp) {
    return log::nanosecondsOf(session.wallOf(stamp));
}

JsonValue causeJson(const std::optional<model::LossCause>& cause) {
    if (!cause) {
        return {};
    }
    constexpr std::array<std::string_view, model::kLossCauses> kNames{"thisComputer", "network", "sender",
                                                                      "unknown", "transport"};
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

double rounded(double value, int decimals) {
    const double perUnit = std::pow(10.0, decimals);
    return std::isfinite(value) ? std::round(value * perUnit) / perUnit : 0.0;
}

JsonValue valueJson(const model::StreamFigures& figures, const model::FigureRow& row) {
    const bool isWhole =
        row.style.form == model::FigureForm::Count || row.style.form == model::FigureForm::Counter;
    return isWhole ? JsonValue(figures.count(row.figure))
                   : JsonValue(rounded(figures[row.figure], row.style.digits.json));
}

JsonValue streamJson(const model::StreamFigures& figures) {
    JsonValue json{{"type", wire::typeDigits(figures.key().type)}};
    for (const model::FigureRow& row : model::figureTable()) {
        if (row.key.empty() || (row.figure == model::Figure::LostOnWay && figures.count(row.figure) == 0)) {
            continue;
        }
        if (row.figure == model::Figure::Skew) {
            json["clock"]["from"] = figures.isFromTimeCode() ? "time code" : "sample counter";
        }
        const std::size_t dot = row.key.find('.');
        JsonValue& object = dot == std::string_view::npos ? json : json[std::string(row.key.substr(0, dot))];
        object[std::string(row.key.substr(dot + 1))] = valueJson(figures, row);
    }
    return json;
}

JsonValue streamsJson(const model::SessionView& session, const model::CharacterKey& key) {
    return listOf(streamsByType(session, key),
                  [](const model::Stream* stream) { return streamJson(model::figuresOf(*stream)); });
}

/// The name that was sent; empty where there was none.
std::string sentName(const model::SessionView& session, const model::CharacterKey& key) {
    const model::MetadataTag* tag = session.messages().metadata(key).find("name");
    return tag != nullptr ? std::string(tag->values.back().text.exact()) : std::string();
}

JsonValue charactersJson(const model::SessionView& session, const model::Sender& sender,
                         const model::TakeVerdicts& verdicts) {
    std::vector<model::CharacterKey> keys;
    for (const model::Character* character : sender.characters) {
        keys.push_back(character->key);
    }
    std::ranges::sort(keys);
    JsonValue::array_t characters;
    for (const model::CharacterKey& key : keys) {
        JsonValue character{{"id", key.character},
                            {"name", sentName(session, key)},
                            {"streams", streamsJson(session, key)},
                            {"state", model::nameOf(verdicts.characters.at(key).state)}};
        if (!session.roster().find(key)->isConfirmed) {
            character["unconfirmed"] = true;
        }
        characters.push_back(std::move(character));
    }
    return characters;
}

/// Null if this computer does not count what it drops.
JsonValue dropsJson(std::uint64_t drops, bool isUncounted) {
    return isUncounted ? JsonValue() : JsonValue(drops);
}

JsonValue senderJson(const model::SessionView& session, const model::Sender& sender,
                     const model::TakeVerdicts& verdicts) {
    JsonValue json{{"address", sender.info.address},
                   {"transport", log::nameOf(sender.info.transport)},
                   {"datagrams", sender.datagrams - sender.malformed - sender.foreign},
                   {"bytes", sender.bytes - sender.skippedBytes - sender.foreignBytes},
                   {"malformed", sender.malformed},
                   {"skippedBytes", sender.skippedBytes},
                   {"characters", charactersJson(session, sender, verdicts)},
                   {"localPort", sender.info.localPort},
                   {"kernelDropped", dropsJson(sender.kernelDrops, sender.hasUncountedDrops)}};
    if (!sender.info.probe.empty()) {
        json["probe"] = sender.info.probe;
    }
    return json;
}

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
    JsonValue object{
        {"id", incident.number},
        {"kind", model::factsOf(incident.kind).word},
        {"cause", causeJson(incident.cause)},
        {"state", model::nameOf(listed.state)},
        {"beginNs", timeJson(session, incident.firstStamp)},
        {"endNs", isOver ? timeJson(session, incident.lastStamp) : JsonValue()},
        {"source", incident.sender == log::kNoSender
                       ? JsonValue()
                       : JsonValue(std::string(session.roster().addressOf(incident.sender).exact()))},
        {"characters", listOf(incident.characters(),
                              [](const model::CharacterKey& one) { return JsonValue(one.character); })},
        {"types",
         listOf(incident.types(), [](std::uint8_t type) { return JsonValue(wire::typeDigits(type)); })},
        {"samples", incident.samples},
        {"count", incident.count},
        {"text", say(fact, words::Form::Headline)},
        {"evidence", say(fact, words::Form::Sentence)}};
    if (const auto addresses = addressesOf(session, incident); addresses.size() > 1) {
        object["sources"] = listOf(addresses, [](const model::ForeignText& address) {
            return JsonValue(std::string(address.exact()));
        });
    }
    if (incident.kind == model::IncidentKind::Content) {
        object["what"] = model::factsOf(incident.what).word;
    }
    return object;
}

} // namespace

std::vector<const model::Stream*> streamsByType(const model::SessionView& session,
                                                const model::CharacterKey& key) {
    const model::Character* character = session.roster().find(key);
    std::vector<const model::Stream*> streams;
    if (character != nullptr) {
        streams = character->streams;
    }
    std::ranges::sort(streams, {}, [](const model::Stream* stream) { return stream->key.type; });
    return streams;
}

std::string figureText(const model::StreamFigures& figures, model::Figure figure, int decimals) {
    switch (model::rowOf(figure).style.form) {
    case model::FigureForm::Count:
        return grouped(figures.count(figure));
    case model::FigureForm::Counter:
        return std::to_string(figures.count(figure));
    case model::FigureForm::Share:
        return fixed(100 * figures.orZero(figure), decimals);
    default:
        return fixed(figures.orZero(figure), decimals);
    }
}

bool hasSentMxtp(const model::Sender& sender) {
    return sender.datagrams > sender.foreign || sender.skippedBytes != 0;
}

struct VerdictLines::Changes {
    JsonValue::array_t changed;
    std::vector<std::uint64_t> gone; ///< their numbers
};

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
    const std::vector<const model::Character*> listed = session.atNow().roster().listed();
    const model::TakeVerdicts verdicts = model::verdictsOf(session, model::recentSpan(session), listed);
    JsonValue characters = listOf(listed, [&](const model::Character* character) {
        return characterJson(session, character->key, verdicts.characters.at(character->key));
    });
    JsonValue object{{"timeNs", timeJson(session, now)},
                     {"verdict", verdictJson(session, verdict)},
                     {"characters", std::move(characters)},
                     {"incidents", changes.changed}};
    if (!changes.gone.empty()) {
        object["gone"] = listOf(changes.gone, [](std::uint64_t number) { return JsonValue(number); });
    }
    return jsonText(object);
}

VerdictLines::Changes VerdictLines::changesOf(const model::SessionView& session) {
    Changes changes;
    std::map<std::uint64_t, std::uint64_t> told;
    for (const model::ListedIncident& listed : model::listedIncidents(session)) {
        JsonValue json = incidentJson(session, listed);
        const std::uint64_t sum = std::hash<std::string>{}(jsonText(json));
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

std::string monitorReport(const model::SessionView& session, const MonitorFacts& facts) {
    const model::SenderTotals all = session.accounts().allSenders();
    const model::RetiredTotals& retired = session.accounts().retired();
    const log::KernelCounters& kernel = session.accounts().kernel();
    std::vector<const model::Character*> everyone;
    for (const model::Character& character : session.roster().characters()) {
        everyone.push_back(&character);
    }
    const model::TakeVerdicts verdicts = model::verdictsOf(session, {}, everyone);
    JsonValue::array_t senders;
    JsonValue::array_t foreignSenders;
    for (const model::Sender& sender : session.roster().senders()) {
        if (hasSentMxtp(sender)) {
            senders.push_back(senderJson(session, sender, verdicts));
        }
        if (sender.foreign != 0) {
            const words::Fact format = sender.foreignFormat();
            const std::string name = say(format, words::Form::Headline);
            foreignSenders.push_back({{"address", sender.info.address},
                                      {"datagrams", sender.foreign},
                                      {"firstBytes", sender.foreignText()},
                                      {"looksLike", name.empty() ? JsonValue() : JsonValue(name)},
                                      {"advice", say(sender.foreignFact(), words::Form::Advice)}});
        }
    }
    JsonValue report{{"durationS", rounded(facts.durationS, 3)},
                     {"local", JsonValue{{"kernelDropped", dropsJson(all.kernelDrops, all.hasUncountedDrops)},
                                         {"receiveBufferBytes", facts.receiveBufferBytes},
                                         {"overtaken", session.accounts().overtaken()},
                                         {"refusedDatagrams", facts.refusedDatagrams},
                                         {"reassemblyFailures", kernel.reassemblyFailures},
                                         {"noPort", kernel.noPort}}},
                     {"foreignDatagrams", all.foreign},
                     {"sources", std::move(senders)},
                     {"foreignSources", std::move(foreignSenders)},
                     {"retired", JsonValue{{"sources", retired.senders},
                                           {"streams", retired.streams},
                                           {"datagrams", retired.wellFormed()},
                                           {"malformed", retired.malformed},
                                           {"samples", retired.samples},
                                           {"lost", retired.lost}}},
                     {"exceeded", JsonValue::array_t(facts.exceeded.begin(), facts.exceeded.end())},
                     {"verdict", verdictJson(session, verdicts.all)},
                     {"incidents", listOf(model::listedIncidents(session),
                                          [&](const auto& one) { return incidentJson(session, one); })}};
    if (facts.hasMemory) {
        const model::MemoryFigures memory = session.memory();
        report["memory"] = {{"sum", memory.sum()}, {"budget", memory.budget()}};
        for (const model::MemoryFigures::Part& part : memory.parts) {
            report["memory"][std::string(part.key)] = part.bytes;
        }
    }
    return jsonText(report);
}

} // namespace posewire::exporting
