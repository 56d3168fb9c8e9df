// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/send_truth.h"

#include "app/cli/output.h"
#include "core/wire/type_table.h"

#include <nlohmann/json.hpp>

namespace posewire::cli {
namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(std::uint8_t type, const performer::StreamFigures& figures) {
    const auto digits = wire::typeDigits(type);
    Json json{{"type", std::string(digits.begin(), digits.end())}, {"datagrams", figures.datagrams}};
    if (wire::isSampled(type)) {
        json["samples"] = figures.samples;
        json["lost"] = figures.lost;
        json["duplicates"] = figures.duplicates;
        json["reordered"] = figures.reordered;
        json["late"] = figures.late;
    }
    json["incomplete"] = figures.incomplete;
    if (wire::isSampled(type)) {
        json["restarts"] = figures.restarts;
        json["step"] = figures.step;
        json["firstSample"] = figures.firstSample;
        json["lastSample"] = figures.lastSample;
    }
    return json;
}

Json jsonOf(const performer::FaultTally& tally) {
    return {{"offered", tally.offered},     {"dropped", tally.dropped},     {"duplicated", tally.duplicated},
            {"reordered", tally.reordered}, {"corrupted", tally.corrupted}, {"truncated", tally.truncated},
            {"withheld", tally.withheld}};
}

Json charactersOf(const performer::Truth& truth) {
    Json characters = Json::array();
    for (const auto& [key, stream] : truth.streams()) {
        if (characters.empty() || characters.back()["id"] != key.character) {
            characters.push_back({{"id", key.character}, {"streams", Json::array()}});
        }
        characters.back()["streams"].push_back(jsonOf(key.type, stream.figures()));
    }
    return characters;
}

Json jsonOf(const SendLine::Sender& sender, const performer::FaultTally& tally) {
    const performer::Truth& truth = sender.isTcp ? sender.streamed.truth() : sender.datagrams;
    const performer::SenderFigures& figures = truth.sender();
    return {{"address", sender.address},
            {"transport", sender.isTcp ? "tcp" : "udp"},
            {"datagrams", figures.datagrams},
            {"bytes", figures.bytes},
            {"malformed", figures.malformed},
            {"skippedBytes", sender.isTcp ? sender.streamed.skippedBytes() : 0},
            {"foreignDatagrams", figures.foreign},
            {"characters", charactersOf(truth)},
            {"faults", jsonOf(tally)}};
}

} // namespace

tl::expected<void, std::string> writeTruth(const std::string& path, const std::vector<SendLine>& lines,
                                           double durationSeconds) {
    Json senders = Json::array();
    std::uint64_t foreign = 0;
    for (const SendLine& line : lines) {
        for (const SendLine::Sender& sender : line.senders()) {
            senders.push_back(jsonOf(sender, line.faults().tally()));
            foreign += senders.back()["foreignDatagrams"].get<std::uint64_t>();
        }
    }
    const Json report{{"durationS", durationSeconds}, {"foreignDatagrams", foreign}, {"sources", senders}};
    auto file = Output::open(path);
    if (!file) {
        return tl::unexpected(file.error());
    }
    file->write(report.dump(2) + "\n");
    return file->finish();
}

} // namespace posewire::cli
