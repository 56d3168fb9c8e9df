// SPDX-License-Identifier: MIT
#include "core/export/protocol_reference.h"

#include "core/model/body/joint_angles.h"
#include "core/model/body/points.h"
#include "core/model/body/segments.h"
#include "core/wire/text.h"
#include "core/wire/type_table.h"

#include "embedded_texts.h"

#include <algorithm>
#include <array>
#include <utility>

namespace posewire::exporting {
namespace {

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

/// All types, with links to their sections.
std::string typeRows() {
    std::string rows;
    for (const wire::TypeInfo& info : wire::typeTable()) {
        const std::string title = wire::typeTitle(info.type);
        rows += row({"[" + title + "](#" + headingAnchor(title) + ")", itemSizes(info),
                     info.frame == wire::Frame::None ? "–" : wire::frameName(info.frame),
                     info.isSampled ? "yes" : "no", info.revisions, info.section});
    }
    return rows;
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

std::string segmentRows() {
    std::string rows;
    for (const model::Segment& segment : model::bodySegments()) {
        const auto index = static_cast<std::size_t>(segment.id - 1);
        const std::string_view parent =
            segment.parent < 0 ? "–"
                               : model::bodySegments()[static_cast<std::size_t>(segment.parent)].displayName;
        rows += row({std::to_string(segment.id), segment.displayName, segment.name, parent,
                     std::to_string(model::unityPlaces()[index] + 1)});
    }
    return rows;
}

std::string fingerRows() {
    std::string rows;
    const auto& hand = model::handSegments();
    for (std::size_t i = 0; i < hand.size(); ++i) {
        const int left = model::kBodySegmentCount + static_cast<int>(i) + 1;
        const std::string_view parent =
            hand[i].parent < 0 ? "hand" : hand[static_cast<std::size_t>(hand[i].parent)].name;
        rows += row(
            {std::to_string(left), std::to_string(left + model::kHandSegmentCount), hand[i].name, parent});
    }
    return rows;
}

std::string pointRows() {
    std::string rows;
    const auto all = model::anatomicalPoints();
    const auto markers = model::markerPoints();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool isMarker = std::find(markers.begin(), markers.end(), static_cast<int>(i)) != markers.end();
        rows += row({model::bodySegments()[static_cast<std::size_t>(all[i].segment)].displayName,
                     std::to_string(all[i].localId), all[i].name, isMarker ? "yes" : ""});
    }
    return rows;
}

std::string pointText(const model::PointReference& point) {
    return std::to_string(point.segmentId) + '.' + std::to_string(point.localId) + " (" +
           std::to_string(model::encodePointId(model::PointIdCoding::By256, point)) + ')';
}

std::string jointRows() {
    std::string rows;
    int number = 0;
    for (const model::JointDefinition& joint : model::jointDefinitions()) {
        rows += row({std::to_string(++number), joint.name, pointText(joint.parent), pointText(joint.child)});
    }
    return rows;
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
    std::string header;
    writeTable(header, wire::headerRows());
    std::string messages;
    for (const wire::TypeInfo& info : wire::typeTable()) {
        writeMessage(messages, info);
    }
    std::string page(protocolReferenceMd());
    for (const auto& [place, text] :
         {std::pair("{types}\n", typeRows()), std::pair("{header}\n", header),
          std::pair("{messages}\n", messages), std::pair("{segments}\n", segmentRows()),
          std::pair("{fingers}\n", fingerRows()), std::pair("{markers}", std::to_string(model::kMarkerCount)),
          std::pair("{points}\n", pointRows()), std::pair("{joints}\n", jointRows())}) {
        page.replace(page.find(place), std::string_view(place).size(), text);
    }
    return page;
}

} // namespace posewire::exporting
