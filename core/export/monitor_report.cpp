// SPDX-License-Identifier: MIT
#include "core/export/monitor_report.h"

#include "core/wire/type_table.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace posewire::exporting {
namespace {

using Json = nlohmann::ordered_json;

double rounded(double value, double perUnit) {
    return std::isfinite(value) ? std::round(value * perUnit) / perUnit : 0.0;
}

std::string digits(std::uint8_t type) {
    const auto characters = wire::typeDigits(type);
    return {characters.begin(), characters.end()};
}

Json streamJson(const StreamFigures& figures) {
    const model::StreamCounts& counts = figures.counts;
    const auto& causes = figures.lostByCause;
    return {{"type", digits(figures.key.type)},
            {"datagrams", counts.datagrams},
            {"samples", counts.samples},
            {"lost", counts.lost},
            {"duplicates", counts.duplicates},
            {"reordered", counts.reordered},
            {"late", counts.late},
            {"incomplete", counts.incomplete},
            {"restarts", counts.restarts},
            {"step", counts.step},
            {"rateHz", rounded(figures.rateHz, 1e3)},
            {"jitterMs", rounded(figures.clock.jitterMs, 1e4)},
            {"longestGapSamples", counts.longestGapSamples},
            {"firstSample", counts.firstSample},
            {"lastSample", counts.lastSample},
            {"bytes", counts.bytes},
            {"malformed", figures.malformed},
            {"lossPercent", rounded(100 * counts.lossRatio(), 1e4)},
            {"causes",
             {{"thisComputer", causes[0]},
              {"network", causes[1]},
              {"sender", causes[2]},
              {"unknown", causes[3]}}},
            {"bursts", figures.pattern.bursts},
            {"burstDensity", rounded(figures.pattern.burstDensity, 1e4)},
            {"gapDensity", rounded(figures.pattern.gapDensity, 1e4)},
            {"meanBurstSamples", rounded(figures.pattern.meanBurstSamples, 1e2)},
            {"intervalMs",
             {{"mean", rounded(figures.arrivals.meanMs, 1e4)},
              {"least", rounded(figures.arrivals.leastMs, 1e4)},
              {"most", rounded(figures.arrivals.mostMs, 1e4)},
              {"deviation", rounded(figures.arrivals.deviationMs, 1e4)}}},
            {"clock",
             {{"from", figures.clock.isFromTimeCode ? "time code" : "sample counter"},
              {"skewPpm", rounded(figures.clock.skewPpm, 1e2)},
              {"driftMs", rounded(figures.clock.driftMs, 1e3)}}}};
}

/// By type, whatever came first.
Json streamsJson(const model::SessionView& session, const model::CharacterKey& key) {
    std::vector<const model::Stream*> streams;
    for (const model::Stream& stream : session.streams()) {
        if (stream.key.sender == key.sender && stream.key.character == key.character) {
            streams.push_back(&stream);
        }
    }
    std::ranges::sort(streams, {}, [](const model::Stream* stream) { return stream->key.type; });
    Json list = Json::array();
    for (const model::Stream* stream : streams) {
        list.push_back(streamJson(figuresOf(session, *stream)));
    }
    return list;
}

Json charactersJson(const model::SessionView& session, const model::Sender& sender) {
    std::vector<model::CharacterKey> keys;
    for (const model::Character& character : session.characters()) {
        if (character.key.sender == sender.id) {
            keys.push_back(character.key);
        }
    }
    std::ranges::sort(keys);
    Json characters = Json::array();
    for (const model::CharacterKey& key : keys) {
        characters.push_back({{"id", key.character},
                              {"name", sentName(session, key)},
                              {"streams", streamsJson(session, key)}});
    }
    return characters;
}

bool isMxtp(const model::Sender& sender) {
    return sender.datagrams > sender.foreign || sender.skippedBytes != 0;
}

Json senderJson(const model::SessionView& session, const model::Sender& sender) {
    return {{"address", sender.info.address},
            {"transport", transportName(sender.info.transport)},
            {"datagrams", sender.datagrams - sender.malformed - sender.foreign},
            {"bytes", sender.bytes - sender.skippedBytes - sender.foreignBytes},
            {"malformed", sender.malformed},
            {"skippedBytes", sender.skippedBytes},
            {"characters", charactersJson(session, sender)},
            {"localPort", sender.info.localPort},
            {"kernelDropped", sender.kernelDrops}};
}

} // namespace

std::string monitorReport(const model::SessionView& session, const MonitorFacts& facts) {
    std::uint64_t kernelDropped = 0;
    std::uint64_t foreign = 0;
    Json senders = Json::array();
    Json foreignSenders = Json::array();
    for (const model::Sender& sender : session.senders()) {
        kernelDropped += sender.kernelDrops;
        foreign += sender.foreign;
        if (isMxtp(sender)) {
            senders.push_back(senderJson(session, sender));
        }
        if (sender.foreign != 0) {
            foreignSenders.push_back({{"address", sender.info.address},
                                      {"datagrams", sender.foreign},
                                      {"firstBytes", sender.foreignText()}});
        }
    }
    const Json report{
        {"durationS", rounded(facts.durationS, 1e3)},
        {"local", {{"kernelDropped", kernelDropped}, {"receiveBufferBytes", facts.receiveBufferBytes}}},
        {"foreignDatagrams", foreign},
        {"sources", std::move(senders)},
        {"foreignSources", std::move(foreignSenders)},
        {"exceeded", facts.exceeded}};
    // Names come from the wire and may hold anything.
    return report.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace posewire::exporting
