// SPDX-License-Identifier: MIT
#include "core/export/protocol_reference.h"

#include "core/model/body/joint_angles.h"
#include "core/model/body/points.h"
#include "core/model/body/segments.h"
#include "core/wire/text.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <array>

namespace posewire::exporting {
namespace {

/// One thing in which the revisions of the specification, or senders, differ.
struct RevisionDifference {
    std::string_view topic;
    std::string_view e;     ///< revision E, 2012
    std::string_view jAndK; ///< revisions J and K, 2015 and 2017
    std::string_view later; ///< revisions L to N since 2018, and what their senders really do
};

constexpr std::array<RevisionDifference, 18> kDifferences{{
    {"header, bytes 17 to 23", "reserved, zero", "reserved, zero",
     "counts of body segments, props and fingers; bytes 20 and 21 reserved; payload size"},
    {"name of byte 16", "avatar ID", "character ID", "character ID"},
    {"unit of positions", "centimetres in the text", "centimetres in the text",
     "metres in types 02, 13, 21 and 24 on the wire, centimetres in 01 and 03"},
    {"point IDs (types 03, 20)", "100 × segment + point", "256 × segment + point (type 03: both are written)",
     "256 × segment + point (type 03: both are written)"},
    {"IDs of the left foot and toe", "23 and 24 in the table", "22 and 23", "22 and 23"},
    {"tags worn by a character", "in unused places of props: position, no rotation", "–", "–"},
    {"sections of header bytes 17 to 23", "–", "2.4.1.7", "N: 2.4.1.7 to 2.4.1.9"},
    {"IDs of props", "24 to 30 in type 11", "25 to 28 in the table",
     "24 to 27 on the wire: go by their place after the body"},
    {"fingers", "–", "–", "20 segments of the left hand, then 20 of the right, after the props"},
    {"type 04", "positions of tags, 16 bytes each", "deprecated",
     "deprecated in the text; the number is used again for a layout that is not published"},
    {"type 05", "–", "Unity3D pose, 32 bytes each", "the same"},
    {"types 10 and 11", "scale and props", "deprecated, replaced by type 13", "deprecated"},
    {"type 12", "the bare text", "text",
     "the length as int32, then the text; also the tags count and timeOffset"},
    {"type 13", "–", "null pose and points in one message of several datagrams", "the same"},
    {"types 20 to 25", "–", "yes", "yes; type 20 may have 26 or 28 items instead of 22"},
    {"type 23, bytes an item", "–", "68",
     "44 in the text since M, 68 on the wire: the payload size shows which"},
    {"type 24", "–", "position, 12 bytes", "36 bytes on the wire: velocity and acceleration follow"},
    {"type 25", "–", "12 characters", "the length 12 as int32, then 12 characters"},
}};

/// Bytes of an item of a message that is one list, or of a message of fixed size; empty if they vary.
std::string itemSize(const wire::FormRow& form) {
    if (form.size != 0) {
        return std::to_string(form.size) + " in all";
    }
    std::string size;
    for (const wire::FieldRow& row : form.fields) {
        if (row.kind == wire::FieldRow::Kind::Items) {
            size = row.size != 0 ? std::to_string(row.size) : std::string();
        }
    }
    return size;
}

std::string itemSizes(const wire::TypeInfo& info) {
    std::string sizes;
    for (const wire::FormRow& form : info.forms) {
        const std::string size = itemSize(form);
        sizes += (sizes.empty() || size.empty() ? "" : " or ") + size;
    }
    return sizes.empty() ? "varies" : sizes;
}

std::string row(std::initializer_list<std::string_view> cells) {
    std::string text;
    for (const std::string_view cell : cells) {
        text.append("| ").append(cell).append(" ");
    }
    return text + "|\n";
}

/// All types in one table with links to their sections, how they are sent, and what differs between
/// revisions.
void writeOverview(std::string& out) {
    out += "## Overview\n\nEvery datagram is the [header](#header) of 24 bytes and the payload of "
           "one message type. *Sampled* types count frames in the header's sample counter; the "
           "others are sent now and then.\n\n"
           "| type | bytes an item | frame | sampled | revisions | section |\n"
           "|---|---|---|---|---|---|\n";
    for (const wire::TypeInfo& info : wire::typeTable()) {
        const std::string title = wire::typeTitle(info.type);
        out += row({"[" + title + "](#" + headingAnchor(title) + ")", itemSizes(info),
                    info.frame == wire::Frame::None ? "–" : wire::frameName(info.frame),
                    info.isSampled ? "yes" : "no", info.revisions, info.section});
    }
    out +=
        "\n## Transport\n\nUDP, or TCP since revision H; port 9763 unless set otherwise. Over UDP the sender "
        "sends to the receiver's address, a datagram in each packet. Over TCP the sender connects and the "
        "receiver "
        "listens; datagrams follow each other without a length in front: each is 24 bytes and the header's "
        "payload "
        "size long, and where that is 0, as its type and number of items say.\n";
    out += "\n## What differs between revisions\n\nRevision E is of 2012, J of 2015, K of 2017; L, M and N "
           "are of 2018. Where a later sender does otherwise than its text, the last column says what it "
           "does.\n\n| | E | J and K | L to N |\n|---|---|---|---|\n";
    for (const RevisionDifference& difference : kDifferences) {
        out += row({difference.topic, difference.e, difference.jAndK, difference.later});
    }
}

using wire::FieldRow;

std::string kindOf(const FieldRow& row) {
    switch (row.kind) {
    case FieldRow::Kind::Value:
        return (row.components > 1 ? std::to_string(row.components) + " × " : std::string()) +
               std::string(wire::scalarName(row.scalar));
    case FieldRow::Kind::Text:
        return std::array{"int32 length, UTF-8", "UTF-8, zero byte",
                          "UTF-8 to the end"}[static_cast<std::size_t>(row.textKind)];
    case FieldRow::Kind::Items:
        return "items × (below)";
    case FieldRow::Kind::CountedItems:
        return "uint32 count, then items (at most " + std::to_string(row.max) + ")";
    }
    return {};
}

/// The rows of one layout; offsets are known as long as everything before is of fixed size.
void writeTable(std::string& out, std::span<const FieldRow> rows) {
    out += "| offset | size | field | type | unit | meaning | section |\n|--:|--:|---|---|---|---|---|\n";
    std::size_t offset = 0;
    bool isKnown = true;
    for (const FieldRow& field : rows) {
        const bool isValue = field.kind == FieldRow::Kind::Value;
        const wire::About& about = field.about;
        out += row({isKnown ? std::to_string(offset) : "…", isValue ? std::to_string(field.size) : "",
                    about.name, kindOf(field), wire::unitSymbol(about.unit), about.text, about.section});
        offset += field.size;
        isKnown = isKnown && isValue;
    }
}

void writeForm(std::string& out, const wire::FormRow& form) {
    if (form.form == wire::Form::Bare) {
        out += "\nWithout the length:\n\n";
    } else if (form.form == wire::Form::Short) {
        out += "\nThe short form:\n\n";
    }
    writeTable(out, form.fields);
    for (const FieldRow& row : form.fields) {
        if (!row.isList()) {
            continue;
        }
        if (row.kind == FieldRow::Kind::CountedItems) {
            out.append("\nEach of the ").append(row.about.name).append(":\n\n");
        } else {
            out +=
                "\nEach item" + (row.size != 0 ? ", " + std::to_string(row.size) + " bytes" : "") + ":\n\n";
        }
        writeTable(out, row.items);
    }
}

void writeMessage(std::string& out, const wire::TypeInfo& info) {
    const std::string_view frame = wire::frameName(info.frame);
    out.append("\n## ").append(wire::typeTitle(info.type)).append("\n\n");
    out.append("Section ").append(info.section).append(", revisions ").append(info.revisions);
    out.append(frame.empty() ? "" : ", ").append(frame).append(".");
    out.append(info.remark.empty() ? "" : " ").append(info.remark).append("\n\n");
    for (const wire::FormRow& form : info.forms) {
        writeForm(out, form);
    }
    if (std::ranges::any_of(info.fields(),
                            [](const FieldRow& row) { return row.about.unit == wire::Unit::TagLines; })) {
        out += "\nKnown tags:";
        for (const std::string_view tag : wire::knownTags()) {
            out.append(" `").append(tag).append("`");
        }
        out += ". A value may contain colons: the first one of a line ends the tag.\n";
    }
}

void writeSegments(std::string& out) {
    out += "\n## Segments\n\nA segment's ID is its place in the pose datagrams, from 1; type 05 has an order "
           "of its own (§2.5.5). Revision E prints 23 and 24 for the left foot and toe. Props follow the "
           "body, then the fingers of the left hand, then those of the right; what is not sent is skipped, "
           "and the IDs of fingers shift by the number of props: a prop or finger is known by its place.\n\n"
           "| ID | segment | sent as | parent | ID in type 05 |\n|--:|---|---|---|--:|\n";
    for (const model::Segment& segment : model::bodySegments()) {
        const auto index = static_cast<std::size_t>(segment.id - 1);
        const std::string_view parent =
            segment.parent < 0 ? "–"
                               : model::bodySegments()[static_cast<std::size_t>(segment.parent)].displayName;
        out += row({std::to_string(segment.id), segment.displayName, segment.name, parent,
                    std::to_string(model::unityPlaces()[index] + 1)});
    }
}

void writeFingers(std::string& out) {
    out +=
        "\n## Fingers\n\nTwenty segments a hand. Names in type 13 begin with the side: LeftCarpus. IDs are "
        "those of a character without props: with props, add their number.\n\n"
        "| ID, left | ID, right | segment | parent |\n|--:|--:|---|---|\n";
    const auto& hand = model::handSegments();
    for (std::size_t i = 0; i < hand.size(); ++i) {
        const int left = model::kBodySegmentCount + static_cast<int>(i) + 1;
        const std::string_view parent =
            hand[i].parent < 0 ? "hand" : hand[static_cast<std::size_t>(hand[i].parent)].name;
        out += row(
            {std::to_string(left), std::to_string(left + model::kHandSegmentCount), hand[i].name, parent});
    }
}

void writePoints(std::string& out) {
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
        out += row({model::bodySegments()[static_cast<std::size_t>(all[i].segment)].displayName,
                    std::to_string(all[i].localId), all[i].name, isMarker ? "yes" : ""});
    }
}

std::string pointText(const model::PointReference& point) {
    return std::to_string(point.segmentId) + '.' + std::to_string(point.localId) + " (" +
           std::to_string(model::encodePointId(model::PointIdCoding::By256, point)) + ')';
}

void writeJoints(std::string& out) {
    out +=
        "\n## Joints\n\nType 20 in its order, each end as segment.point and the number on the wire. The last "
        "six are ergonomic angles, which older senders leave out. Pelvis_T8 and Vertical_T8 have the same "
        "IDs: only the place tells them apart.\n\n"
        "| no. | joint | parent | child |\n|--:|---|---|---|\n";
    int number = 0;
    for (const model::JointDefinition& joint : model::jointDefinitions()) {
        out += row({std::to_string(++number), joint.name, pointText(joint.parent), pointText(joint.child)});
    }
}

} // namespace

std::string headingAnchor(std::string_view title) {
    std::string anchor;
    for (const char character : title) {
        const char small = wire::lower(character);
        if ((small >= 'a' && small <= 'z') || (small >= '0' && small <= '9')) {
            anchor += small;
        } else if (small == ' ' || small == '-') {
            anchor += '-';
        }
    }
    return anchor;
}

std::string protocolReference() {
    std::string out =
        "# MXTP protocol reference\n\nAll numbers are big-endian. Offsets count from the start of the "
        "header, the payload or the item; … means that something before it varies in size.\nSections are "
        "those of the specification, revision K, where "
        "no other revision is named.\n\n";
    writeOverview(out);
    out += "\n## Header\n\nBytes 17 to 23 are reserved and zero in revisions E to K.\n\n";
    writeTable(out, wire::headerRows());
    out +=
        "\nThe datagram counter of a sample in three datagrams is 0, 1 and 0x82; of one in a single datagram "
        "0x80. The sample counter may skip: a stream sent at half the rate of capture counts 2, 4, 6. "
        "Quaternions "
        "are re, i, j, k of unit length; q and −q are the same orientation, and senders may use either.\n";
    for (const wire::TypeInfo& info : wire::typeTable()) {
        writeMessage(out, info);
    }
    writeSegments(out);
    writeFingers(out);
    writePoints(out);
    writeJoints(out);
    return out;
}

} // namespace posewire::exporting
