// SPDX-License-Identifier: MIT
#include "core/export/null_pose_sheet.h"

#include "core/export/json_fields.h"
#include "core/model/body/spaces.h"

namespace posewire::exporting {
namespace {

void addPose(const model::NullPose& pose, Json& object) {
    object["stampNs"] = log::nanosecondsOf(pose.stamp);
    object["packet"] = pose.packet;
    object["partsReceived"] = pose.partsReceived;
    object["partsExpected"] = pose.partsExpected;
    Json segments = Json::array();
    for (std::size_t i = 0; i < pose.segments.size(); ++i) {
        const auto& segment = pose.segments[i];
        segments.push_back({{"id", static_cast<std::uint64_t>(i + 1)},
                            {"name", jsonOf(segment.name)},
                            {"position", jsonOf(model::toFloats(segment.position))}});
    }
    object["segments"] = std::move(segments);
    Json points = Json::array();
    for (const auto& point : pose.points) {
        points.push_back({{"segment", point.segment},
                          {"point", point.id},
                          {"name", jsonOf(point.name)},
                          {"flags", point.flags},
                          {"position", jsonOf(model::toFloats(point.position))}});
    }
    object["points"] = std::move(points);
}

Json scaleOf(const wire::ScaleInformation& scale) {
    Json list = Json::array();
    for (const wire::SegmentScale& segment : scale.segments) {
        list.push_back(
            {{"id", segment.id}, {"offset", jsonOf(segment.offset)}, {"matrix", jsonOf(segment.matrix)}});
    }
    return list;
}

Json propsOf(const wire::PropInformation& props) {
    Json list = Json::array();
    for (const wire::Prop& prop : props.props) {
        list.push_back({{"id", prop.id}, {"name", jsonOf(prop.name)}});
    }
    return list;
}

} // namespace

std::string nullPoseJson(const NullPoseSheet& sheet) {
    Json object = Json::object();
    object["character"] = jsonOf(sheet.character);
    if (sheet.pose != nullptr) {
        addPose(*sheet.pose, object);
    }
    if (sheet.scale != nullptr) {
        object["scale"] = scaleOf(*sheet.scale);
    }
    if (sheet.props != nullptr) {
        object["props"] = propsOf(*sheet.props);
    }
    return object.dump(2) + "\n";
}

} // namespace posewire::exporting
