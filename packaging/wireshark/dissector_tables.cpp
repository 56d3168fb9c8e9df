// SPDX-License-Identifier: GPL-3.0-or-later
#include "packaging/wireshark/dissector_tables.h"

#include "core/model/body/joint_angles.h"
#include "core/model/body/points.h"
#include "core/model/body/segments.h"
#include "core/wire/faults.h"
#include "core/wire/messages.h"
#include "core/wire/text.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <utility>

namespace posewire::wireshark {
namespace {

using wire::FieldRow;
using wire::RefersTo;

std::string quoted(std::string_view text) {
    std::string out = "\"";
    for (const char character : text) {
        out += character == '"' || character == '\\' ? "\\" : "";
        out += character;
    }
    return out + '"';
}

std::string entry(std::string_view key, std::string_view value) {
    return std::string(key) + " = " + quoted(value) + ", ";
}

std::string entry(std::string_view key, std::size_t value) {
    return std::string(key) + " = " + std::to_string(value) + ", ";
}

/// "segments" holds one "segment" each.
std::string singular(std::string_view list) {
    return std::string(list.substr(0, list.size() - (list.ends_with('s') ? 1 : 0)));
}

std::string_view kindOf(const FieldRow& row) {
    switch (row.kind) {
    case FieldRow::Kind::Value:
        return row.scalar == wire::Scalar::Float32 ? "floats" : wire::scalarName(row.scalar);
    case FieldRow::Kind::Text:
        return row.textKind == wire::TextKind::Prefixed         ? "prefixed_text"
               : row.textKind == wire::TextKind::ZeroTerminated ? "zero_text"
                                                                : "rest_text";
    case FieldRow::Kind::Items:
        return "items";
    case FieldRow::Kind::CountedItems:
        return "counted_items";
    }
    return "";
}

/// The components of a vector as names of fields: "x", "re", "m11"; a single float is a vector of one.
std::string partsOf(const FieldRow& row) {
    if (row.scalar == wire::Scalar::Float32 && row.components == 1) {
        return quoted("value");
    }
    std::string parts;
    for (const std::string_view declared : wire::componentNames(row.components)) {
        std::string name(declared);
        const bool isMatrix = std::erase(name, ',') != 0;
        parts += (parts.empty() ? "" : ", ") + quoted(isMatrix ? 'm' + name : name);
    }
    return parts;
}

/// What the numbers of a field stand for; empty where they stand for themselves.
std::string_view namesOf(RefersTo what) {
    switch (what) {
    case RefersTo::JointEnd:
        return "joint_end";
    case RefersTo::Point:
        return "point";
    case RefersTo::UnitySegment:
        return "unity_segment";
    case RefersTo::Segment:
    case RefersTo::Tracker:
    case RefersTo::Carrier:
        return "segment";
    default:
        return "";
    }
}

bool isHeaderField(std::string_view name) {
    return std::ranges::any_of(wire::headerRows(),
                               [&](const FieldRow& row) { return row.about.name == name; });
}

/// Writes a layout as a list of fields. `prefix` is what their filter names begin with.
class LayoutWriter {
public:
    LayoutWriter(std::string& out, std::string prefix, std::string indent, bool isHeader = false)
        : m_out(out), m_prefix(std::move(prefix)), m_indent(std::move(indent)), m_isHeader(isHeader) {}

    void write(std::span<const FieldRow> rows) {
        for (const FieldRow& row : rows) {
            m_out += m_indent + "{ " + entry("name", row.about.name) +
                     entry("filter", filterOf(row.about.name)) + entry("kind", kindOf(row));
            if (row.isList()) {
                list(row);
            } else if (row.kind == FieldRow::Kind::Value) {
                value(row);
            }
            end(row.about);
        }
    }

private:
    /// A name that the header has too gets the payload's own prefix.
    std::string filterOf(std::string_view name) const {
        const bool isTaken = !m_isHeader && m_prefix == "mxtp" && isHeaderField(name);
        return m_prefix + (isTaken ? ".body." : ".") + std::string(name);
    }
    void end(const wire::About& about) {
        m_out += entry("unit", wire::unitSymbol(about.unit));
        m_out += '\n' + m_indent + "  " + entry("text", about.text) + entry("section", about.section);
        m_out.resize(m_out.size() - 2);
        m_out += " },\n";
    }
    void value(const FieldRow& row) {
        m_out += entry("size", row.size);
        const std::string parts = partsOf(row);
        m_out += parts.empty() ? "" : "parts = { " + parts + " }, ";
        m_out += row.about.unit == wire::Unit::Flags ? "hexadecimal = true, " : "";
        const RefersTo what = row.about.refersTo;
        const std::string_view names = namesOf(what);
        if (names.empty()) {
            return;
        }
        const bool isOfItem = what != RefersTo::Carrier;
        m_out += entry("names", names);
        if (what != RefersTo::JointEnd) {
            m_out += entry("name_filter", (isOfItem ? m_prefix : filterOf(row.about.name)) + ".name");
        }
        m_out += isOfItem && names.ends_with("segment") ? "checked = true, " : "";
    }
    void list(const FieldRow& row) {
        const std::string item = singular(row.about.name);
        m_out += entry("item", item) + entry("item_filter", m_prefix + '.' + item);
        m_out += row.max == 0 ? "" : entry("max", row.max) + entry("least", row.least);
        m_out += row.size == 0 ? "" : entry("size", row.size);
        if (row.about.refersTo == RefersTo::Joint) {
            m_out += "places = joint_names, " + entry("name_filter", m_prefix + '.' + item + ".name");
        }
        m_out += "\n" + m_indent + "  fields = {\n";
        LayoutWriter(m_out, m_prefix + '.' + item, m_indent + "    ").write(row.items);
        m_out += m_indent + "  }, ";
    }

    std::string& m_out;
    std::string m_prefix;
    std::string m_indent;
    bool m_isHeader;
};

std::string_view formName(wire::Form form) {
    return form == wire::Form::Bare ? "bare" : form == wire::Form::Short ? "short" : "standard";
}

void writeMessage(std::string& out, const wire::TypeInfo& info) {
    const std::string_view frame = wire::frameName(info.frame);
    out += "-- Section " + std::string(info.section) + ", revisions " + std::string(info.revisions);
    out.append(frame.empty() ? "" : ", ").append(frame).append(".\n");
    out += "messages[" + std::to_string(info.type) + "] = {\n  " + entry("title", info.name);
    out += wire::countsSegments(info.type) ? "has_segments = true,\n" : "\n";
    out += "  forms = {\n";
    for (const wire::FormRow& form : info.forms) {
        out.append("    ").append(formName(form.form)).append(" = {\n");
        LayoutWriter(out, "mxtp", "      ").write(form.fields);
        out += "    },\n";
    }
    out += "  },\n}\n";
}

/// Replaces the numbers from 1001 on with names in braces.
std::string asTemplate(std::string text, std::initializer_list<const char*> names) {
    int number = 1001;
    for (const char* name : names) {
        const std::string digits = std::to_string(number++);
        for (std::size_t at = 0; (at = text.find(digits, at)) != std::string::npos;) {
            text.replace(at, digits.size(), '{' + std::string(name) + '}');
        }
    }
    return text;
}

void writeTexts(std::string& out) {
    out += "local error_texts = {\n";
    for (std::size_t i = 0; i < wire::kErrorCodeCount; ++i) {
        const auto code = static_cast<wire::ErrorCode>(i);
        out += "  " + std::string(wire::errorName(code)) + " = " +
               quoted(asTemplate(wire::errorText({code, 0, 1001, 1002, 1003}), {"offset", "need", "have"})) +
               ",\n";
    }
    out += "}\nlocal notice_texts = {\n";
    for (std::size_t i = 0; i < wire::kNoticeCodeCount; ++i) {
        const auto code = static_cast<wire::NoticeCode>(i);
        out += "  " + std::string(wire::noticeName(code)) + " = " +
               quoted(asTemplate(wire::noticeText({code, 1001, 1002}), {"offset", "count"})) + ",\n";
    }
    out += "}\n";
}

/// Adds words as a Lua list, as many a line as fit.
class ListWriter {
public:
    ListWriter(std::string& out, std::string_view begin) : m_out(out), m_lineStart(out.size()) {
        m_out += begin;
    }
    void add(const std::string& word) {
        if (m_out.size() - m_lineStart + word.size() > 116) {
            m_out += '\n';
            m_lineStart = m_out.size();
            m_out += "   ";
        }
        m_out += ' ' + word + ',';
    }
    void end() { m_out += " }\n"; }

private:
    std::string& m_out;
    std::size_t m_lineStart;
};

template <class List, class Word>
void writeList(std::string& out, std::string_view begin, const List& list, Word&& word) {
    ListWriter writer(out, begin);
    for (const auto& element : list) {
        writer.add(word(element));
    }
    writer.end();
}

void writePoints(std::string& out) {
    out += "-- By segment and local ID.\nlocal points = {\n";
    for (const model::Segment& segment : model::bodySegments()) {
        ListWriter writer(out, "  [" + std::to_string(segment.id) + "] = {");
        for (const model::AnatomicalPoint& point : model::anatomicalPoints()) {
            if (point.segment == segment.id - 1) {
                writer.add('[' + std::to_string(point.localId) + "] = " + quoted(point.name));
            }
        }
        out += " },\n";
    }
    out += "}\n";
}

void writeNames(std::string& out) {
    const auto nameOf = [](const auto& row) { return quoted(row.name); };
    writeList(out, "local body_segments = {", model::bodySegments(), nameOf);
    writeList(out, "local hand_segments = {", model::handSegments(), nameOf);
    out += "-- Places in body_segments.\n";
    writeList(out, "local unity_order = {", model::unityOrder(),
              [](int index) { return std::to_string(index + 1); });
    writeList(out, "local joint_names = {", model::jointDefinitions(), nameOf);
    writeList(out, "local known_tags = {", wire::knownTags(),
              [](std::string_view tag) { return '[' + quoted(tag) + "] = true"; });
    writePoints(out);
}

} // namespace

std::string dissectorTables() {
    std::string out;
    out += "local most_bytes, most_segments, most_props, most_points = " +
           std::to_string(wire::kMaxDatagramSize) + ", " + std::to_string(wire::kMaxSegments) + ", " +
           std::to_string(model::kMaxPropCount) + ", " + std::to_string(wire::kMaxNullPosePoints) + "\n";
    writeTexts(out);
    writeNames(out);
    out += "\nlocal header_layout = {\n";
    LayoutWriter(out, "mxtp", "  ", true).write(wire::headerRows());
    out += "}\n\nlocal messages = {}\n";
    for (const wire::TypeInfo& info : wire::typeTable()) {
        writeMessage(out, info);
    }
    return out;
}

} // namespace posewire::wireshark
