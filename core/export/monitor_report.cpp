// SPDX-License-Identifier: MIT
#include "core/export/reports.h"

#include "core/export/json_value.h"
#include "core/export/session_reading.h"
#include "core/export/verdict_json.h"
#include "core/model/session/accounts.h"
#include "core/model/session/memory_figures.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <cmath>

namespace posewire::exporting {
namespace {

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
        if (row.key.empty()) {
            continue;
        }
        if (row.figure == model::Figure::Skew) {
            json["clock"]["from"] = figures.isFromTimeCode() ? "time code" : "sample counter";
        }
        const std::size_t dot = row.key.find('.');
        JsonValue& object = dot == std::string_view::npos ? json : json[row.key.substr(0, dot)];
        object[row.key.substr(dot + 1)] = valueJson(figures, row);
    }
    return json;
}

JsonValue streamsJson(const model::SessionView& session, const model::CharacterKey& key) {
    JsonValue::List list;
    for (const model::Stream* stream : streamsByType(session, key)) {
        list.push_back(streamJson(model::figuresOf(*stream)));
    }
    return list;
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
    JsonValue::List characters;
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

JsonValue senderJson(const model::SessionView& session, const model::Sender& sender,
                     const model::TakeVerdicts& verdicts) {
    return {{"address", sender.info.address},
            {"transport", log::nameOf(sender.info.transport)},
            {"datagrams", sender.datagrams - sender.malformed - sender.foreign},
            {"bytes", sender.bytes - sender.skippedBytes - sender.foreignBytes},
            {"malformed", sender.malformed},
            {"skippedBytes", sender.skippedBytes},
            {"characters", charactersJson(session, sender, verdicts)},
            {"localPort", sender.info.localPort},
            {"kernelDropped", sender.kernelDrops}};
}

JsonValue memoryJson(const model::MemoryFigures& memory) {
    JsonValue json{{"sum", memory.sum()}, {"budget", memory.budget()}};
    for (const model::MemoryFigures::Part& part : memory.parts) {
        json[part.key] = part.bytes;
    }
    return json;
}

} // namespace

std::string monitorReport(const model::SessionView& session, const MonitorFacts& facts) {
    const model::SenderTotals all = session.accounts().allSenders();
    const model::RetiredTotals& retired = session.accounts().retired();
    std::vector<const model::Character*> everyone;
    for (const model::Character& character : session.roster().characters()) {
        everyone.push_back(&character);
    }
    const model::TakeVerdicts verdicts = model::verdictsOf(session, {}, everyone);
    JsonValue::List senders;
    JsonValue::List foreignSenders;
    for (const model::Sender& sender : session.roster().senders()) {
        if (hasSentMxtp(sender)) {
            senders.push_back(senderJson(session, sender, verdicts));
        }
        if (sender.foreign != 0) {
            foreignSenders.push_back({{"address", sender.info.address},
                                      {"datagrams", sender.foreign},
                                      {"firstBytes", sender.foreignText()}});
        }
    }
    JsonValue report{{"durationS", rounded(facts.durationS, 3)},
                     {"local", JsonValue{{"kernelDropped", all.kernelDrops},
                                         {"receiveBufferBytes", facts.receiveBufferBytes},
                                         {"overtaken", session.accounts().overtaken()},
                                         {"refusedDatagrams", facts.refusedDatagrams}}},
                     {"foreignDatagrams", all.foreign},
                     {"sources", std::move(senders)},
                     {"foreignSources", std::move(foreignSenders)},
                     {"retired", JsonValue{{"sources", retired.senders},
                                           {"streams", retired.streams},
                                           {"datagrams", retired.wellFormed()},
                                           {"malformed", retired.malformed},
                                           {"samples", retired.samples},
                                           {"lost", retired.lost}}},
                     {"exceeded", JsonValue::List(facts.exceeded.begin(), facts.exceeded.end())},
                     {"verdict", verdictJson(session, verdicts.all)},
                     {"incidents", incidentsJson(session)}};
    if (facts.hasMemory) {
        report["memory"] = memoryJson(session.memory());
    }
    return report.text();
}

} // namespace posewire::exporting
