// SPDX-License-Identifier: MIT
#include "core/export/event_sheet.h"

#include "core/export/csv.h"
#include "core/export/json_value.h"
#include "core/wire/type_table.h"

#include <array>

namespace posewire::exporting {
namespace {

using model::Event;

constexpr std::string_view kHeader =
    "number,severity,group,event,source,character,type,from,to,firstPacket,lastPacket,count,samples,cause,"
    "current,text\r\n";

std::string addressOf(const model::SessionView& session, const Event& event) {
    const model::Sender* sender = session.find(event.sender);
    return sender == nullptr ? std::string() : sender->info.address;
}

std::string secondsText(log::Stamp stamp) {
    constexpr std::chrono::seconds kSecond(1);
    const log::Duration time = stamp.time_since_epoch();
    const std::string decimals = std::to_string((time % kSecond).count());
    return std::to_string(time / kSecond) + '.' + std::string(9 - decimals.size(), '0') + decimals;
}

JsonValue objectOf(const model::SessionView& session, const Event& event) {
    JsonValue object{{"number", event.number},
                     {"severity", nameOf(event.severity())},
                     {"group", nameOf(event.group())},
                     {"event", model::nameOf(event.kind)},
                     {"source", addressOf(session, event)}};
    if (event.character) {
        object["character"] = *event.character;
    }
    if (event.type) {
        object["type"] = wire::typeDigits(*event.type);
    }
    object["fromNs"] = log::nanosecondsOf(event.firstStamp);
    object["toNs"] = log::nanosecondsOf(event.lastStamp);
    object["firstPacket"] = event.firstPacket;
    object["lastPacket"] = event.lastPacket;
    object["count"] = event.count;
    object["samples"] = event.samples;
    if (event.cause) {
        object["cause"] = model::nameOf(*event.cause);
    }
    object["current"] = event.isCurrent;
    object["text"] = event.text();
    return object;
}

} // namespace

std::string_view nameOf(model::EventSeverity severity) {
    constexpr std::array<std::string_view, 3> kNames{"info", "warning", "error"};
    return kNames[static_cast<std::size_t>(severity)];
}

std::string_view nameOf(model::EventGroup group) {
    constexpr std::array<std::string_view, 4> kNames{"source", "loss", "content", "limit"};
    return kNames[static_cast<std::size_t>(group)];
}

std::string eventsCsv(const model::SessionView& session, std::span<const Event* const> events) {
    std::string text(kHeader);
    for (const Event* event : events) {
        const std::array<std::string, 16> cells{
            std::to_string(event->number),
            std::string(nameOf(event->severity())),
            std::string(nameOf(event->group())),
            std::string(model::nameOf(event->kind)),
            addressOf(session, *event),
            event->character ? std::to_string(*event->character) : std::string(),
            event->type ? wire::typeDigits(*event->type) : std::string(),
            secondsText(event->firstStamp),
            secondsText(event->lastStamp),
            std::to_string(event->firstPacket),
            std::to_string(event->lastPacket),
            std::to_string(event->count),
            std::to_string(event->samples),
            event->cause ? std::string(model::nameOf(*event->cause)) : std::string(),
            event->isCurrent ? "yes" : "no",
            event->text()};
        text += csvLine(cells);
    }
    return text;
}

std::string eventsJson(const model::SessionView& session, std::span<const Event* const> events) {
    std::string text = "[";
    for (std::size_t i = 0; i < events.size(); ++i) {
        text += (i == 0 ? "\n" : ",\n") + objectOf(session, *events[i]).text();
    }
    return text + "\n]\n";
}

} // namespace posewire::exporting
