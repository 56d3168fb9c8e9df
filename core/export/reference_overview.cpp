// SPDX-License-Identifier: MIT
#include "core/export/reference_overview.h"

#include "core/wire/schema.h"
#include "core/wire/type_table.h"

#include <array>

namespace posewire::exporting {
namespace {

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
    {"type 23, bytes an item", "–", "68", "44 in the text since M, 68 on the wire: the payload size tells"},
    {"type 24", "–", "position, 12 bytes", "36 bytes on the wire: velocity and acceleration follow"},
    {"type 25", "–", "12 characters", "the length 12 as int32, then 12 characters"},
}};

/// Bytes of an item of a message that is one list, or of a message of fixed size; empty where they vary.
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

std::string itemSizes(const wire::MessageRow& message) {
    std::string sizes;
    for (const wire::FormRow& form : message.forms) {
        const std::string size = itemSize(form);
        sizes += (sizes.empty() || size.empty() ? "" : " or ") + size;
    }
    return sizes.empty() ? "varies" : sizes;
}

void writeRow(std::string& out, const wire::MessageRow& message) {
    const wire::TypeInfo& info = *wire::findType(message.type);
    const std::string title = wire::typeTitle(message.type);
    out += "| [" + title + "](#" + headingAnchor(title) + ") | " + itemSizes(message) + " | ";
    out.append(info.frame == wire::Frame::None ? "–" : wire::frameName(info.frame)).append(" | ");
    out.append(info.isSampled ? "yes" : "no").append(" | ");
    out.append(info.revisions).append(" | ").append(info.section).append(" |\n");
}

} // namespace

std::span<const RevisionDifference> revisionDifferences() {
    return kDifferences;
}

std::string headingAnchor(std::string_view title) {
    std::string anchor;
    for (const char character : title) {
        const bool isUpper = character >= 'A' && character <= 'Z';
        const bool isKept = (character >= 'a' && character <= 'z') || (character >= '0' && character <= '9');
        if (isUpper || isKept) {
            anchor += isUpper ? static_cast<char>(character - 'A' + 'a') : character;
        } else if (character == ' ' || character == '-') {
            anchor += '-';
        }
    }
    return anchor;
}

std::string referenceOverview() {
    std::string out = "## Overview\n\nEvery datagram is the [header](#header) of 24 bytes and the payload of "
                      "one message type. *Sampled* types count frames in the header's sample counter; the "
                      "others are sent now and then.\n\n"
                      "| type | bytes an item | frame | sampled | revisions | section |\n"
                      "|---|---|---|---|---|---|\n";
    for (const wire::MessageRow& message : wire::messageRows()) {
        writeRow(out, message);
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
    for (const RevisionDifference& row : kDifferences) {
        out.append("| ").append(row.topic).append(" | ").append(row.e).append(" | ");
        out.append(row.jAndK).append(" | ").append(row.later).append(" |\n");
    }
    return out;
}

} // namespace posewire::exporting
