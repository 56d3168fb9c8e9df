// SPDX-License-Identifier: MIT
#include "core/export/reference_tables.h"

#include "core/model/body/joint_angles.h"
#include "core/model/body/points.h"
#include "core/model/body/segments.h"

namespace posewire::exporting {
namespace {

void segments(std::string& out) {
    out += "\n## Segments\n\nA segment's ID is its place in the pose datagrams, from 1; type 05 has an order "
           "of its own (§2.5.5). Revision E prints 23 and 24 for the left foot and toe. Props follow the "
           "body, then the fingers of the left hand, then those of the right; what is not sent is skipped, "
           "and the IDs of fingers shift by the number of props: a prop or finger is known by its place.\n\n"
           "| ID | segment | parent | ID in type 05 |\n|--:|---|---|--:|\n";
    for (const model::Segment& segment : model::bodySegments()) {
        const auto index = static_cast<std::size_t>(segment.id - 1);
        out += "| " + std::to_string(segment.id) + " | " + std::string(segment.name) + " | ";
        out += segment.parent < 0
                   ? std::string("–")
                   : std::string(model::bodySegments()[static_cast<std::size_t>(segment.parent)].name);
        out += " | " + std::to_string(model::unityPlaces()[index] + 1) + " |\n";
    }
}

void fingers(std::string& out) {
    out +=
        "\n## Fingers\n\nTwenty segments a hand. Names in type 13 begin with the side: LeftCarpus. IDs are "
        "those of a character without props: with props, add their number.\n\n"
        "| ID, left | ID, right | segment | parent |\n|--:|--:|---|---|\n";
    const auto& hand = model::handSegments();
    for (std::size_t i = 0; i < hand.size(); ++i) {
        const int left = model::kBodySegmentCount + static_cast<int>(i) + 1;
        out += "| " + std::to_string(left) + " | " + std::to_string(left + model::kHandSegmentCount) + " | ";
        out.append(hand[i].name).append(" | ");
        out += hand[i].parent < 0 ? std::string("hand")
                                  : std::string(hand[static_cast<std::size_t>(hand[i].parent)].name);
        out += " |\n";
    }
}

void points(std::string& out) {
    out += "\n## Points\n\nPoints in types 03, 13 and 20. In types 03 and 20 a point's ID is 256 × segment + "
           "point: pSacrum is 256 × 1 + 13 = 269; revision E has 100 × segment + point: 113. Point 0 is the "
           "segment itself. The " +
           std::to_string(model::kMarkerCount) +
           " points with a mark are those of optical marker sets, which type 03 sends.\n\n"
           "| segment | point | name | marker |\n|---|--:|---|---|\n";
    const auto all = model::anatomicalPoints();
    const auto markers = model::markerPoints();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool isMarker = std::find(markers.begin(), markers.end(), static_cast<int>(i)) != markers.end();
        out += "| " + std::string(model::bodySegments()[static_cast<std::size_t>(all[i].segment)].name) +
               " | " + std::to_string(all[i].localId) + " | " + std::string(all[i].name) + " | " +
               (isMarker ? "yes" : "") + " |\n";
    }
}

std::string pointText(const model::PointReference& point) {
    return std::to_string(point.segmentId) + '.' + std::to_string(point.localId) + " (" +
           std::to_string(model::encodePointId(model::PointIdCoding::By256, point)) + ')';
}

void joints(std::string& out) {
    out +=
        "\n## Joints\n\nType 20 in its order, each end as segment.point and the number on the wire. The last "
        "six are ergonomic angles, which older senders leave out. Pelvis_T8 and Vertical_T8 have the same "
        "IDs: only the place tells them apart.\n\n"
        "| no. | joint | parent | child |\n|--:|---|---|---|\n";
    int number = 0;
    for (const model::JointDefinition& joint : model::jointDefinitions()) {
        out += "| " + std::to_string(++number) + " | " + std::string(joint.name) + " | " +
               pointText(joint.parent) + " | " + pointText(joint.child) + " |\n";
    }
}

} // namespace

std::string referenceTables() {
    std::string out;
    segments(out);
    fingers(out);
    points(out);
    joints(out);
    return out;
}

} // namespace posewire::exporting
