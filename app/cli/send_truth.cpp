// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/send_truth.h"

#include "app/cli/output.h"
#include "core/export/json_value.h"
#include "core/wire/type_table.h"

#include <optional>
#include <utility>

namespace posewire::cli {
namespace {

using exporting::JsonValue;

JsonValue jsonOf(std::uint8_t type, const performer::SentFigures& figures) {
    JsonValue json{{"type", wire::typeDigits(type)}, {"datagrams", figures.datagrams}};
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

JsonValue jsonOf(const performer::FaultTally& tally) {
    return {{"offered", tally.offered},     {"dropped", tally.dropped},     {"duplicated", tally.duplicated},
            {"reordered", tally.reordered}, {"corrupted", tally.corrupted}, {"truncated", tally.truncated},
            {"withheld", tally.withheld}};
}

/// The streams of a truth are in the order of their characters.
JsonValue::List charactersOf(const performer::Truth& truth) {
    JsonValue::List characters;
    JsonValue::List streams;
    std::optional<std::uint8_t> character;
    const auto finish = [&] {
        if (character) {
            characters.push_back({{"id", *character}, {"streams", std::exchange(streams, {})}});
        }
    };
    for (const auto& [key, stream] : truth.streams()) {
        if (character != key.character) {
            finish();
            character = key.character;
        }
        streams.push_back(jsonOf(key.type, stream.figures()));
    }
    finish();
    return characters;
}

JsonValue jsonOf(const SendLine::Sender& sender, const performer::FaultTally& tally) {
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
    JsonValue::List senders;
    std::uint64_t foreign = 0;
    for (const SendLine& line : lines) {
        for (const SendLine::Sender& sender : line.senders()) {
            senders.push_back(jsonOf(sender, line.faults().tally()));
            foreign += (sender.isTcp ? sender.streamed.truth() : sender.datagrams).sender().foreign;
        }
    }
    const JsonValue report{
        {"durationS", durationSeconds}, {"foreignDatagrams", foreign}, {"sources", std::move(senders)}};
    auto file = Output::open(path);
    if (!file) {
        return tl::unexpected(file.error());
    }
    file->write(report.text(2) + "\n");
    return file->finish();
}

} // namespace posewire::cli
