// SPDX-License-Identifier: MIT
#include "core/performer/messages.h"

namespace posewire::performer {

using Eigen::Vector3d;
using model::toFloats;

wire::ScaleInformation scaleInformation(const Character& character) {
    const model::ReferenceBody& body = character.body();
    const auto scale = static_cast<float>(body.stature / model::kReferenceStature);
    wire::ScaleInformation message;
    for (std::size_t index = 0; index < model::kBodySegmentCount; ++index) {
        const Vector3d offset = body.origins[index] - model::referenceOrigins()[index];
        message.segments.push_back({static_cast<std::uint32_t>(index + 1),
                                    toFloats(offset),
                                    {scale, 0.0F, 0.0F, 0.0F, scale, 0.0F, 0.0F, 0.0F, scale}});
    }
    return message;
}

wire::PropInformation propInformation(const Character& character, const MessageDialect& dialect) {
    const model::SegmentLayout& layout = character.layout();
    wire::PropInformation message;
    for (int prop = 0; prop < layout.props; ++prop) {
        message.props.push_back(
            {segmentId(layout, layout.body + prop, dialect), std::string(propName(prop))});
    }
    return message;
}

wire::MetaData metaData(const Character& character, int characterCount, const MessageDialect& dialect) {
    const Identity& identity = character.identity();
    wire::MetaData message;
    message.hasLengthPrefix = dialect.prefixesMetaData;
    message.text = "color:" + identity.colour + "\n";
    if (dialect.sendsRealTags) {
        message.text += "count:" + std::to_string(characterCount) + "\n";
    }
    message.text += "name:" + identity.name + "\n";
    if (dialect.sendsRealTags) {
        message.text += "timeOffset:0\n";
    }
    message.text += "xmid:" + identity.suitId + "\n";
    return message;
}

std::vector<wire::NullPose> nullPoseParts(const Character& character) {
    const model::SegmentLayout& layout = character.layout();
    const std::vector<Vector3d> origins = character.nullPose();
    std::vector<wire::NullPose> parts(1);
    for (int position = 0; position < layout.count(); ++position) {
        const bool isProp = model::placeOf(layout, position)->kind == model::SegmentKind::Prop;
        const std::string_view name =
            isProp ? propName(position - layout.body) : model::segmentName(layout, position);
        parts.front().segments.push_back(
            {std::string(name), toFloats(origins[static_cast<std::size_t>(position)])});
    }
    // 30 points of up to 48 bytes stay within an Ethernet frame.
    constexpr std::size_t kPointsPerPart = 30;
    const auto points = model::anatomicalPoints();
    for (std::size_t place = 0; place < points.size(); ++place) {
        if (place % kPointsPerPart == 0) {
            parts.emplace_back();
        }
        const model::AnatomicalPoint& point = points[place];
        parts.back().points.push_back({static_cast<std::uint16_t>(point.segment + 1),
                                       static_cast<std::uint16_t>(point.localId), std::string(point.name), 0,
                                       toFloats(character.body().points[place])});
    }
    return parts;
}

} // namespace posewire::performer
