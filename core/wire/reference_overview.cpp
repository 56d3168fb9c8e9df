// SPDX-License-Identifier: MIT
#include "core/wire/reference_overview.h"

#include "core/wire/messages.h"
#include "core/wire/type_table.h"

#include <array>
#include <utility>

namespace posewire::wire {
namespace {

constexpr std::array<RevisionDifference, 16> kDifferences{{
    {"header, bytes 17 to 23", "reserved, zero", "reserved, zero",
     "counts of body segments, props and fingers; bytes 20 and 21 reserved; payload size"},
    {"name of byte 16", "avatar ID", "character ID", "character ID"},
    {"unit of positions", "centimetres in the text", "centimetres in the text",
     "metres in types 02, 13, 21 and 24 on the wire, centimetres in 01 and 03"},
    {"point IDs (types 03, 20)", "100 × segment + point", "256 × segment + point (type 03: both are written)",
     "256 × segment + point (type 03: both are written)"},
    {"IDs of the left foot and toe", "23 and 24 in the table", "22 and 23", "22 and 23"},
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

/// Bytes of an item of a message that is one list, or of a message of fixed size; "" where they vary.
template <class T, Form F>
std::string itemSize() {
    if constexpr (kIsFixed<T, F>) {
        return std::to_string(kWireSize<T, F>) + " in all";
    } else {
        std::string size;
        const auto add = [&]<auto Member, Form ItemForm>(const Items<Member, ItemForm>&) {
            using Item = typename MemberValue<Member>::value_type;
            size = kIsFixed<Item, ItemForm> ? std::to_string(kWireSize<Item, ItemForm>) : std::string();
        };
        forEachField<T, F>([&](const auto& field) {
            if constexpr (requires { add(field); }) {
                add(field);
            }
        });
        return size;
    }
}

template <class T>
std::string itemSizes() {
    std::string sizes = itemSize<T, Form::Standard>();
    if constexpr (requires { Layout<T, Form::Short>::fields; }) {
        sizes += " or " + itemSize<T, Form::Short>();
    }
    if constexpr (kIsFixed<T> && requires { Layout<T, Form::Bare>::fields; }) {
        sizes += " or " + itemSize<T, Form::Bare>();
    }
    return sizes.empty() ? "varies" : sizes;
}

template <class T>
void writeRow(std::string& out) {
    const TypeInfo& info = *findType(T::kType);
    const std::string title = typeTitle(T::kType);
    out += "| [" + title + "](#" + headingAnchor(title) + ") | " + itemSizes<T>() + " | ";
    out.append(info.frame.empty() ? "–" : info.frame).append(" | ");
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
    [&]<std::size_t... I>(std::index_sequence<I...>) {
        (writeRow<std::variant_alternative_t<I + 1, Body>>(out), ...);
    }
    (std::make_index_sequence<std::variant_size_v<Body> - 1>{});
    out += "\n## What differs between revisions\n\nRevision E is of 2012, J of 2015, K of 2017; L, M and N "
           "are of 2018. Where a later sender does otherwise than its text, the last column says what it "
           "does.\n\n| | E | J and K | L to N |\n|---|---|---|---|\n";
    for (const RevisionDifference& row : kDifferences) {
        out.append("| ").append(row.topic).append(" | ").append(row.e).append(" | ");
        out.append(row.jAndK).append(" | ").append(row.later).append(" |\n");
    }
    return out;
}

} // namespace posewire::wire
