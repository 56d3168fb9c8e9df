// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/input_output.h"
#include "app/cli/send.h"
#include "core/export/json_value.h"
#include "core/model/accounting/stream_figures.h"
#include "core/wire/type_table.h"

#include <array>
#include <optional>
#include <utility>

namespace posewire::cli {
namespace {

using exporting::JsonValue;

/// What `monitor` has to count of a stream, in the order of its report.
std::array<std::pair<model::Figure, std::uint64_t>, 11> valuesOf(const performer::SentFigures& sent) {
    using enum model::Figure;
    return {{{Datagrams, sent.datagrams},
             {Samples, sent.samples},
             {Lost, sent.lost},
             {Duplicates, sent.duplicates},
             {Reordered, sent.reordered},
             {Late, sent.late},
             {Incomplete, sent.incomplete},
             {Restarts, sent.restarts},
             {Step, sent.step},
             {FirstSample, sent.firstSample},
             {LastSample, sent.lastSample}}};
}

JsonValue jsonOf(std::uint8_t type, const performer::SentFigures& sent) {
    JsonValue json{{"type", wire::typeDigits(type)}};
    for (const auto& [figure, value] : valuesOf(sent)) {
        const model::FigureRow& row = model::rowOf(figure);
        if (wire::isSampled(type) || row.scope == model::FigureScope::Messages) {
            json[row.key] = value;
        }
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
    return Output::writeFile(path, report.text(2) + "\n");
}

} // namespace posewire::cli
