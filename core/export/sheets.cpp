// SPDX-License-Identifier: MIT
#include "core/export/sheets.h"

#include "core/export/json_value.h"
#include "core/model/body/spaces.h"
#include "core/model/session/listed_incidents.h"
#include "core/model/session/roster.h"
#include "core/wire/byte_order.h"
#include "core/wire/text.h"
#include "core/wire/type_table.h"
#include "core/words/say.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace posewire::exporting {
namespace {

void addCell(const std::string& content, std::string& line) {
    if (content.find_first_of(",\"\r\n") == std::string::npos) {
        line += content;
        return;
    }
    line += '"';
    for (const char letter : content) {
        line.append(letter == '"' ? 2 : 1, letter);
    }
    line += '"';
}

using model::Incident;

constexpr std::string_view kEventHeader =
    "number,severity,group,event,source,characters,types,from,to,firstPacket,lastPacket,count,samples,cause,"
    "current,text\r\n";

std::string_view nameOf(model::IncidentSeverity severity) {
    constexpr std::array<std::string_view, 3> kNames{"info", "warning", "error"};
    return kNames[static_cast<std::size_t>(severity)];
}

std::string_view nameOf(model::IncidentGroup group) {
    constexpr std::array<std::string_view, 4> kNames{"source", "loss", "content", "limit"};
    return kNames[static_cast<std::size_t>(group)];
}

/// "1 2 4".
template <class Value, class ToText>
std::string joined(const std::vector<Value>& values, ToText&& toText) {
    std::string text;
    for (const Value& value : values) {
        text += (text.empty() ? "" : " ") + toText(value);
    }
    return text;
}

/// "10.0.0.2:50001 10.0.0.3:50002".
std::string sourceOf(const model::SessionView& session, const Incident& event) {
    return joined(addressesOf(session, event),
                  [](const model::ForeignText& address) { return std::string(address.exact()); });
}

JsonValue objectOf(const model::SessionView& session, const Incident& event) {
    JsonValue object{{"number", event.number},
                     {"severity", nameOf(event.severity())},
                     {"group", nameOf(event.group())},
                     {"event", model::nameOf(event.kind)},
                     {"source", sourceOf(session, event)}};
    object["characters"] =
        listOf(event.characters(), [](const model::CharacterKey& one) { return JsonValue(one.character); });
    object["types"] =
        listOf(event.types(), [](std::uint8_t type) { return JsonValue(wire::typeDigits(type)); });
    object["fromNs"] = log::nanosecondsOf(session.wallOf(event.firstStamp));
    object["toNs"] = log::nanosecondsOf(session.wallOf(event.lastStamp));
    object["firstPacket"] = event.firstPacket;
    object["lastPacket"] = event.lastPacket;
    object["count"] = event.count;
    object["samples"] = event.samples;
    if (event.cause) {
        object["cause"] = model::nameOf(*event.cause);
    }
    object["current"] = event.isCurrent;
    object["text"] = say(event.fact(), words::Form::Sentence);
    return object;
}

constexpr std::string_view kNullPoseHeader =
    "kind,segment,point,name,flags,x,y,z,m11,m12,m13,m21,m22,m23,m31,m32,m33\r\n";
constexpr std::size_t kNullPoseColumns = 17;

std::string flagsText(std::uint32_t flags) {
    std::array<std::byte, 4> bytes{};
    wire::store32(bytes.data(), flags);
    return "0x" + wire::hexadecimal(bytes);
}

/// A line with these cells and numbers; the rest is empty.
std::string nullPoseLine(std::vector<std::string> cells, std::span<const float> values,
                         std::span<const float> further = {}) {
    for (const std::span<const float> numbers : {values, further}) {
        std::ranges::transform(numbers, std::back_inserter(cells), numberText);
    }
    cells.resize(kNullPoseColumns);
    return csvLine(cells);
}

void addPoseRows(const model::NullPose& pose, std::string& text) {
    int id = 0;
    for (const auto& segment : pose.segments) {
        text += nullPoseLine({"segment", std::to_string(++id), "", segment.name.csv(), ""},
                             model::toFloats(segment.position));
    }
    for (const auto& point : pose.points) {
        text += nullPoseLine({"point", std::to_string(point.segment), std::to_string(point.id),
                              point.name.csv(), flagsText(point.flags)},
                             model::toFloats(point.position));
    }
}

/// A number that is not finite is written as in decoded messages: "NaN", "Infinity" or "-Infinity".
template <std::size_t N>
JsonValue vectorOf(const std::array<float, N>& numbers) {
    JsonValue list = JsonValue::array();
    for (const float number : numbers) {
        list.push_back(std::isfinite(number) ? floatJson(number) : JsonValue(numberText(number)));
    }
    return list;
}

void addPose(const model::NullPose& pose, log::WallTime time, JsonValue& object) {
    object["stampNs"] = log::nanosecondsOf(time);
    object["packet"] = pose.packet;
    object["partsReceived"] = pose.partsReceived;
    object["partsExpected"] = pose.partsExpected;
    std::uint32_t id = 0;
    object["segments"] = listOf(pose.segments, [&id](const auto& segment) {
        return JsonValue{{"id", ++id},
                         {"name", segment.name.exact()},
                         {"position", vectorOf(model::toFloats(segment.position))}};
    });
    object["points"] = listOf(pose.points, [](const auto& point) {
        return JsonValue{{"segment", point.segment},
                         {"point", point.id},
                         {"name", point.name.exact()},
                         {"flags", point.flags},
                         {"position", vectorOf(model::toFloats(point.position))}};
    });
}

} // namespace

std::string csvLine(std::span<const std::string> cells) {
    std::string line;
    for (const std::string& cell : cells) {
        line += &cell == cells.data() ? "" : ",";
        addCell(cell, line);
    }
    return line + "\r\n";
}

std::string eventsCsv(const EventSheet& sheet) {
    std::string text(kEventHeader);
    for (const Incident* event : sheet.events) {
        const std::array<std::string, 16> cells{
            std::to_string(event->number),
            std::string(nameOf(event->severity())),
            std::string(nameOf(event->group())),
            std::string(model::nameOf(event->kind)),
            joined(addressesOf(sheet.session, *event), [](const auto& address) { return address.csv(); }),
            joined(event->characters(),
                   [](const model::CharacterKey& one) { return std::to_string(one.character); }),
            joined(event->types(), wire::typeDigits),
            log::secondsText(sheet.session.wallOf(event->firstStamp).time_since_epoch()),
            log::secondsText(sheet.session.wallOf(event->lastStamp).time_since_epoch()),
            std::to_string(event->firstPacket),
            std::to_string(event->lastPacket),
            std::to_string(event->count),
            std::to_string(event->samples),
            event->cause ? std::string(model::nameOf(*event->cause)) : std::string(),
            event->isCurrent ? "yes" : "no",
            model::csvText(say(event->fact(), words::Form::Sentence))};
        text += csvLine(cells);
    }
    return text;
}

std::string eventsJson(const EventSheet& sheet) {
    std::string text = "[";
    for (std::size_t i = 0; i < sheet.events.size(); ++i) {
        text += (i == 0 ? "\n" : ",\n") + jsonText(objectOf(sheet.session, *sheet.events[i]));
    }
    return text + "\n]\n";
}

std::string nullPoseCsv(const NullPoseSheet& sheet) {
    std::string text(kNullPoseHeader);
    if (sheet.pose != nullptr) {
        addPoseRows(*sheet.pose, text);
    }
    if (sheet.scale != nullptr) {
        for (const wire::SegmentScale& segment : sheet.scale->segments) {
            text += nullPoseLine({"scale", std::to_string(segment.id), "", "", ""}, segment.offset,
                                 segment.matrix);
        }
    }
    if (sheet.props != nullptr) {
        for (const wire::Prop& prop : sheet.props->props) {
            text +=
                nullPoseLine({"prop", std::to_string(prop.id), "", model::ForeignText(prop.name).csv()}, {});
        }
    }
    return text;
}

std::string nullPoseJson(const NullPoseSheet& sheet) {
    JsonValue object{{"character", sheet.character.exact()}};
    if (sheet.pose != nullptr) {
        addPose(*sheet.pose, sheet.time, object);
    }
    if (sheet.scale != nullptr) {
        object["scale"] = listOf(sheet.scale->segments, [](const wire::SegmentScale& segment) {
            return JsonValue{{"id", segment.id},
                             {"offset", vectorOf(segment.offset)},
                             {"matrix", vectorOf(segment.matrix)}};
        });
    }
    if (sheet.props != nullptr) {
        object["props"] = listOf(sheet.props->props, [](const wire::Prop& prop) {
            return JsonValue{{"id", prop.id}, {"name", prop.name}};
        });
    }
    return jsonText(object, 2) + "\n";
}

} // namespace posewire::exporting
