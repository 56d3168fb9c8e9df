// SPDX-License-Identifier: MIT
#include "core/export/motion/pose_lines.h"

#include "core/export/json_value.h"
#include "core/export/motion/motion_writer.h"
#include "core/wire/type_table.h"

#include <initializer_list>

namespace posewire::exporting {
namespace {

void appendList(std::initializer_list<double> values, std::string& text) {
    char before = '[';
    for (const double value : values) {
        text += before;
        appendNumber(value, text);
        before = ',';
    }
    text += ']';
}

void appendSegments(const model::CharacterPose& pose, std::string& text) {
    bool isFirst = true;
    for (std::size_t i = 0; i < pose.segments.size(); ++i) {
        const std::string_view name = model::segmentName(pose.layout, static_cast<int>(i));
        if (!pose.isPresent(i) || name.empty()) {
            continue;
        }
        text += isFirst ? "{\"id\":" : ",{\"id\":";
        text += std::to_string(i + 1);
        text.append(",\"name\":\"").append(name).append("\",\"position\":");
        const model::SegmentPose& segment = pose.segments[i];
        appendList({segment.position.x(), segment.position.y(), segment.position.z()}, text);
        text += ",\"orientation\":";
        const Eigen::Quaterniond& turn = segment.orientation;
        appendList({turn.w(), turn.x(), turn.y(), turn.z()}, text);
        const auto from = static_cast<std::size_t>(pose.sources[i].weaker());
        text.append(",\"from\":\"").append(kProvenanceNames[from]).append("\"}");
        isFirst = false;
    }
}

} // namespace

void appendPose(const model::CharacterPose& pose, const std::string& receivedNs, std::string_view timeOfDay,
                std::string& line) {
    line += (receivedNs.empty() ? "" : ",\"receivedNs\":" + receivedNs) +
            ",\"timeCode\":" + std::to_string(pose.timeCode);
    if (!timeOfDay.empty()) {
        line.append(",\"timeOfDay\":\"").append(timeOfDay).append("\"");
    }
    line += ",\"type\":\"" + wire::typeDigits(pose.type) + "\",\"segments\":[";
    appendSegments(pose, line);
    line += "]}";
}

std::string poseLine(const log::PacketLog& log, const feed::PoseCharacter& character,
                     const feed::PoseSample& sample) {
    const model::CharacterPose& pose = sample.pose;
    const auto sender = log.senders().find(character.key.sender);
    std::string line = "{\"character\":" + jsonText(character.name.shown()) +
                       ",\"id\":" + std::to_string(character.key.character) +
                       ",\"source\":" + jsonText(sender != nullptr ? sender->address : std::string()) +
                       ",\"sample\":" + std::to_string(pose.sample);
    line += sample.beginsRun ? ",\"begins\":true" : "";
    appendPose(pose, std::to_string(log::nanosecondsOf(log.timeline().wallOf(pose.stamp))), {}, line);
    return line;
}

} // namespace posewire::exporting
