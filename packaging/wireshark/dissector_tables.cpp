// SPDX-License-Identifier: GPL-3.0-or-later
#include "packaging/wireshark/dissector_tables.h"

#include "core/model/body/joint_angles.h"
#include "core/model/body/points.h"
#include "core/model/body/segments.h"
#include "core/wire/header.h"
#include "core/wire/messages.h"
#include "core/wire/metadata_text.h"
#include "core/wire/notice.h"
#include "core/wire/type_table.h"

#include <utility>

namespace posewire::wireshark {
namespace {

using wire::Form;

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

template <class Value>
constexpr std::string_view kindOf() {
    if constexpr (std::is_same_v<Value, std::uint8_t>) {
        return "uint8";
    } else if constexpr (std::is_same_v<Value, std::uint16_t>) {
        return "uint16";
    } else if constexpr (std::is_same_v<Value, std::uint32_t>) {
        return "uint32";
    } else if constexpr (std::is_same_v<Value, std::int32_t>) {
        return "int32";
    } else if constexpr (std::is_same_v<typename Value::value_type, char>) {
        return "characters";
    } else {
        return "floats";
    }
}

template <class Value>
constexpr std::string_view partsOf() {
    if constexpr (std::is_same_v<Value, wire::Vec3>) {
        return R"({ "x", "y", "z" })";
    } else if constexpr (std::is_same_v<Value, wire::Quat>) {
        return R"({ "re", "i", "j", "k" })";
    } else if constexpr (std::is_same_v<Value, wire::Mat3>) {
        return R"({ "m11", "m12", "m13", "m21", "m22", "m23", "m31", "m32", "m33" })";
    } else {
        return "";
    }
}

constexpr std::string_view kindOf(wire::TextKind kind) {
    switch (kind) {
    case wire::TextKind::Prefixed:
        return "prefixed_text";
    case wire::TextKind::ZeroTerminated:
        return "zero_text";
    case wire::TextKind::ToEnd:
        return "rest_text";
    }
    return "";
}

/// What the numbers of a field stand for; empty where they stand for themselves.
template <auto Member, Form F>
constexpr std::string_view namesOf() {
    using Owner = typename wire::MemberOf<decltype(Member)>::Owner;
    if constexpr (std::is_same_v<Owner, wire::Prop> || !std::is_integral_v<wire::MemberValue<Member>>) {
        return "";
    } else if constexpr (std::is_same_v<Owner, wire::Joint>) {
        return "joint_end";
    } else if constexpr (std::is_same_v<Owner, wire::NullPosePoint>) {
        return sizeof(wire::MemberValue<Member>) == 2 ? "segment" : "";
    } else if constexpr (std::is_same_v<Owner, wire::Point>) {
        return "point";
    } else if constexpr (requires(Owner owner) { owner.id; } && !std::is_same_v<Owner, wire::Header>) {
        return F == Form::Unity ? "unity_segment" : "segment";
    } else {
        return "";
    }
}

bool isHeaderField(std::string_view name) {
    bool found = false;
    wire::forEachField<wire::Header, Form::Standard>(
        [&](const auto& field) { found = found || field.about.name == name; });
    return found;
}

/// Writes a layout as a list of fields. `prefix` is what their filter names begin with.
template <class T, Form F>
class LayoutWriter {
public:
    LayoutWriter(std::string& out, std::string prefix, std::string indent)
        : m_out(out), m_prefix(std::move(prefix)), m_indent(std::move(indent)) {}

    template <auto Member>
    void operator()(const wire::Field<Member>& field) {
        using Value = wire::MemberValue<Member>;
        begin(field.about, kindOf<Value>());
        m_out += entry("size", sizeof(Value));
        if constexpr (!partsOf<Value>().empty()) {
            m_out.append("parts = ").append(partsOf<Value>()).append(", ");
        }
        m_out += field.about.unit == wire::Unit::Flags ? "hexadecimal = true, " : "";
        nameIds<Member>(field.about.name);
        end(field.about);
    }
    template <auto Member, wire::TextKind Kind>
    void operator()(const wire::Text<Member, Kind>& field) {
        begin(field.about, kindOf(Kind));
        end(field.about);
    }
    template <auto Member, Form ItemForm>
    void operator()(const wire::Items<Member, ItemForm>& field) {
        list<typename wire::MemberValue<Member>::value_type, ItemForm>(field.about, 0);
    }
    template <auto Member, std::size_t Max>
    void operator()(const wire::CountedList<Member, Max>& field) {
        list<typename wire::MemberValue<Member>::value_type, Form::Standard>(field.about, Max);
    }

private:
    /// A name that the header has too gets the payload's own prefix.
    std::string filterOf(std::string_view name) const {
        const bool isTaken = !std::is_same_v<T, wire::Header> && m_prefix == "mxtp" && isHeaderField(name);
        return m_prefix + (isTaken ? ".body." : ".") + std::string(name);
    }
    void begin(const wire::About& about, std::string_view kind) {
        m_out += m_indent + "{ " + entry("name", about.name) + entry("filter", filterOf(about.name)) +
                 entry("kind", kind);
    }
    void end(const wire::About& about) {
        m_out += entry("unit", wire::unitSymbol(about.unit));
        m_out += '\n' + m_indent + "  " + entry("text", about.text) + entry("section", about.section);
        m_out.resize(m_out.size() - 2);
        m_out += " },\n";
    }
    template <auto Member>
    void nameIds(std::string_view name) {
        constexpr std::string_view names = namesOf<Member, F>();
        if constexpr (!names.empty() && !std::is_same_v<T, wire::NullPosePoint>) {
            m_out += entry("names", names);
            m_out += std::is_same_v<T, wire::Joint> ? "" : entry("name_filter", m_prefix + ".name");
            m_out += names.find("segment") != std::string_view::npos ? "checked = true, " : "";
        } else if constexpr (!names.empty()) {
            if (name == "segment") {
                m_out += entry("names", names) + entry("name_filter", m_prefix + ".segment.name");
            }
        }
    }
    template <class Item, Form ItemForm>
    void list(const wire::About& about, std::size_t max) {
        const std::string item = singular(about.name);
        begin(about, max == 0 ? "items" : "counted_items");
        m_out += entry("item", item) + entry("item_filter", m_prefix + '.' + item);
        m_out += max == 0 ? "" : entry("max", max) + entry("least", wire::kWireSize<Item>);
        m_out += wire::kIsFixed<Item, ItemForm> ? entry("size", wire::kWireSize<Item, ItemForm>) : "";
        if constexpr (std::is_same_v<Item, wire::Joint>) {
            m_out += "places = joint_names, " + entry("name_filter", m_prefix + '.' + item + ".name");
        }
        m_out += "\n" + m_indent + "  fields = {\n";
        wire::forEachField<Item, ItemForm>(
            LayoutWriter<Item, ItemForm>(m_out, m_prefix + '.' + item, m_indent + "    "));
        m_out += m_indent + "  }, ";
        end(about);
    }

    std::string& m_out;
    std::string m_prefix;
    std::string m_indent;
};

template <class T, Form F>
void writeForm(std::string& out, std::string_view name) {
    out.append("    ").append(name).append(" = {\n");
    wire::forEachField<T, F>(LayoutWriter<T, F>(out, "mxtp", "      "));
    out += "    },\n";
}

/// Types whose items are the segments that the header counts.
template <class T>
inline constexpr bool kHasSegments =
    std::is_same_v<T, wire::PoseEuler> || std::is_same_v<T, wire::PoseQuaternion> ||
    std::is_same_v<T, wire::LinearKinematics> || std::is_same_v<T, wire::AngularKinematics>;

template <class T>
void writeMessage(std::string& out) {
    const wire::TypeInfo& info = *wire::findType(T::kType);
    out += "-- Section " + std::string(info.section) + ", revisions " + std::string(info.revisions);
    out.append(info.frame.empty() ? "" : ", ").append(info.frame).append(".\n");
    out += "messages[" + std::to_string(T::kType) + "] = {\n  " + entry("title", info.name);
    out += kHasSegments<T> ? "has_segments = true,\n" : "\n";
    out += "  forms = {\n";
    writeForm<T, Form::Standard>(out, "standard");
    if constexpr (requires { wire::Layout<T, Form::Bare>::fields; }) {
        writeForm<T, Form::Bare>(out, "bare");
    }
    if constexpr (requires { wire::Layout<T, Form::Short>::fields; }) {
        writeForm<T, Form::Short>(out, "short");
    }
    out += "  },\n}\n";
}

/// A text with three numbers in it as a format for them.
std::string asFormat(std::string text) {
    for (const std::string_view number : {"1001", "1002", "1003"}) {
        if (const std::size_t place = text.find(number); place != std::string::npos) {
            text.replace(place, number.size(), "%d");
        }
    }
    return text;
}

void writeTexts(std::string& out) {
    out += "-- In the order offset, need, have.\nlocal error_texts = {\n";
    for (std::size_t i = 0; i < wire::kErrorCodeCount; ++i) {
        const auto code = static_cast<wire::ErrorCode>(i);
        out += "  " + std::string(wire::errorName(code)) + " = " +
               quoted(asFormat(wire::errorText({code, 0, 1001, 1002, 1003}))) + ",\n";
    }
    out += "}\n-- In the order offset, count.\nlocal notice_texts = {\n";
    for (std::size_t i = 0; i < wire::kNoticeCodeCount; ++i) {
        const auto code = static_cast<wire::NoticeCode>(i);
        out += "  " + std::string(wire::noticeName(code)) + " = " +
               quoted(asFormat(wire::noticeText({code, 1001, 1002}))) + ",\n";
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
    wire::forEachField<wire::Header, Form::Standard>(
        LayoutWriter<wire::Header, Form::Standard>(out, "mxtp", "  "));
    out += "}\n\nlocal messages = {}\n";
    [&]<std::size_t... I>(std::index_sequence<I...>) {
        (writeMessage<std::variant_alternative_t<I + 1, wire::Body>>(out), ...);
    }
    (std::make_index_sequence<std::variant_size_v<wire::Body> - 1>{});
    return out;
}

} // namespace posewire::wireshark
