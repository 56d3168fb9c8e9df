// SPDX-License-Identifier: MIT
#include "core/export/protocol_reference.h"

#include "core/export/reference_overview.h"
#include "core/export/reference_tables.h"
#include "core/wire/metadata_text.h"
#include "core/wire/schema.h"
#include "core/wire/type_table.h"

#include <algorithm>

namespace posewire::exporting {
namespace {

using wire::FieldRow;

std::string kindOf(const FieldRow& row) {
    switch (row.kind) {
    case FieldRow::Kind::Value:
        return (row.components > 1 ? std::to_string(row.components) + " × " : std::string()) +
               std::string(wire::scalarName(row.scalar));
    case FieldRow::Kind::Text:
        return row.textKind == wire::TextKind::Prefixed         ? "int32 length, UTF-8"
               : row.textKind == wire::TextKind::ZeroTerminated ? "UTF-8, zero byte"
                                                                : "UTF-8 to the end";
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
    for (const FieldRow& row : rows) {
        const bool isValue = row.kind == FieldRow::Kind::Value;
        const wire::About& about = row.about;
        out += "| " + (isKnown ? std::to_string(offset) : std::string("…")) + " | ";
        out += (isValue ? std::to_string(row.size) : std::string()) + " | ";
        out.append(about.name).append(" | ").append(kindOf(row)).append(" | ");
        out.append(wire::unitSymbol(about.unit)).append(" | ").append(about.text).append(" | ");
        out.append(about.section).append(" |\n");
        offset += row.size;
        isKnown = isKnown && isValue;
    }
}

void writeForm(std::string& out, const wire::FormRow& form) {
    switch (form.form) {
    case wire::Form::Bare:
        out += "\nWithout the length:\n\n";
        break;
    case wire::Form::Short:
        out += "\nThe short form:\n\n";
        break;
    default:
        break;
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

bool hasTags(const wire::MessageRow& message) {
    return std::ranges::any_of(message.fields(),
                               [](const FieldRow& row) { return row.about.unit == wire::Unit::TagLines; });
}

void writeMessage(std::string& out, const wire::MessageRow& message) {
    const wire::TypeInfo& info = *wire::findType(message.type);
    const std::string_view frame = wire::frameName(info.frame);
    out.append("\n## ").append(wire::typeTitle(message.type)).append("\n\n");
    out.append("Section ").append(info.section).append(", revisions ").append(info.revisions);
    out.append(frame.empty() ? "" : ", ").append(frame).append(".");
    out.append(info.remark.empty() ? "" : " ").append(info.remark).append("\n\n");
    for (const wire::FormRow& form : message.forms) {
        writeForm(out, form);
    }
    if (hasTags(message)) {
        out += "\nKnown tags:";
        for (const std::string_view tag : wire::knownTags()) {
            out.append(" `").append(tag).append("`");
        }
        out += ". A value may contain colons: the first one of a line ends the tag.\n";
    }
}

} // namespace

std::string protocolReference() {
    std::string out =
        "# MXTP protocol reference\n\nAll numbers are big-endian. Offsets count from the start of the "
        "header, the payload or the item; … means that something before it varies in size.\nSections are "
        "those of the specification, revision K, where "
        "no other revision is named.\n\n";
    out += referenceOverview();
    out += "\n## Header\n\nBytes 17 to 23 are reserved and zero in revisions E to K.\n\n";
    writeTable(out, wire::headerRows());
    out +=
        "\nThe datagram counter of a sample in three datagrams is 0, 1 and 0x82; of one in a single datagram "
        "0x80. The sample counter may skip: a stream sent at half the rate of capture counts 2, 4, 6. "
        "Quaternions "
        "are re, i, j, k of unit length; q and −q are the same orientation, and senders may use either.\n";
    for (const wire::MessageRow& message : wire::messageRows()) {
        writeMessage(out, message);
    }
    out += referenceTables();
    return out;
}

} // namespace posewire::exporting
