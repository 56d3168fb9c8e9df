// SPDX-License-Identifier: MIT
#include "core/wire/reference.h"

#include "core/wire/codec.h"
#include "core/wire/reference_overview.h"
#include "core/wire/type_table.h"

#include <utility>

namespace posewire::wire {
namespace {

template <class Value>
constexpr std::string_view kindOf() {
    if constexpr (std::is_same_v<Value, Vec3>) {
        return "3 × float32";
    } else if constexpr (std::is_same_v<Value, Quat>) {
        return "4 × float32";
    } else if constexpr (std::is_same_v<Value, Mat3>) {
        return "9 × float32";
    } else if constexpr (std::is_same_v<Value, std::uint8_t>) {
        return "uint8";
    } else if constexpr (std::is_same_v<Value, std::uint16_t>) {
        return "uint16";
    } else if constexpr (std::is_same_v<Value, std::uint32_t>) {
        return "uint32";
    } else if constexpr (std::is_same_v<Value, std::int32_t>) {
        return "int32";
    } else {
        return "characters";
    }
}

constexpr std::string_view kindOf(TextKind kind) {
    switch (kind) {
    case TextKind::Prefixed:
        return "int32 length, UTF-8";
    case TextKind::ZeroTerminated:
        return "UTF-8, zero byte";
    case TextKind::ToEnd:
        return "UTF-8 to the end";
    }
    return "";
}

/// Writes the rows of one layout; offsets are known as long as everything before is of fixed size.
class TableWriter {
public:
    explicit TableWriter(std::string& out) : m_out(out) {
        m_out +=
            "| offset | size | field | type | unit | meaning | section |\n|--:|--:|---|---|---|---|---|\n";
    }

    template <auto Member>
    void operator()(const Field<Member>& field) {
        constexpr std::size_t size = sizeof(MemberValue<Member>);
        row(std::to_string(size), field.about, kindOf<MemberValue<Member>>());
        m_offset += size;
    }
    template <auto Member, TextKind Kind>
    void operator()(const Text<Member, Kind>& field) {
        row("", field.about, kindOf(Kind));
        m_isKnown = false;
    }
    template <auto Member, Form ItemForm>
    void operator()(const Items<Member, ItemForm>& field) {
        row("", field.about, "items × (below)");
        m_isKnown = false;
    }
    template <auto Member, std::size_t Max>
    void operator()(const CountedList<Member, Max>& field) {
        row("", field.about, "uint32 count, then items (at most " + std::to_string(Max) + ")");
        m_isKnown = false;
    }

private:
    void row(const std::string& size, const About& about, std::string_view kind) {
        m_out += "| " + (m_isKnown ? std::to_string(m_offset) : std::string("…")) + " | " + size + " | ";
        m_out.append(about.name).append(" | ").append(kind).append(" | ").append(unitSymbol(about.unit));
        m_out.append(" | ").append(about.text).append(" | ").append(about.section).append(" |\n");
    }

    std::string& m_out;
    std::size_t m_offset = 0;
    bool m_isKnown = true;
};

template <class T, Form F>
void writeTable(std::string& out) {
    forEachField<T, F>(TableWriter(out));
}

template <class FieldType>
struct ItemOf {
    static void write(std::string&, std::string_view) {}
};
template <auto Member, Form ItemForm>
struct ItemOf<Items<Member, ItemForm>> {
    static void write(std::string& out, std::string_view) {
        using Item = typename MemberValue<Member>::value_type;
        if constexpr (kIsFixed<Item, ItemForm>) {
            out += "\nEach item, " + std::to_string(kWireSize<Item, ItemForm>) + " bytes:\n\n";
        } else {
            out += "\nEach item:\n\n";
        }
        writeTable<Item, ItemForm>(out);
    }
};
template <auto Member, std::size_t Max>
struct ItemOf<CountedList<Member, Max>> {
    static void write(std::string& out, std::string_view listName) {
        out.append("\nEach of the ").append(listName).append(":\n\n");
        writeTable<typename MemberValue<Member>::value_type, Form::Standard>(out);
    }
};

template <class T, Form F>
void writeForm(std::string& out, std::string_view title) {
    out.append(title.empty() ? "" : "\n").append(title).append(title.empty() ? "" : "\n\n");
    writeTable<T, F>(out);
    forEachField<T, F>([&](const auto& field) {
        ItemOf<std::remove_cvref_t<decltype(field)>>::write(out, field.about.name);
    });
}

template <class T>
void writeMessage(std::string& out) {
    const TypeInfo& info = *findType(T::kType);
    out.append("\n## ").append(typeTitle(T::kType)).append("\n\n");
    out.append("Section ").append(info.section).append(", revisions ").append(info.revisions);
    out.append(info.frame.empty() ? "" : ", ").append(info.frame).append(".");
    out.append(info.remark.empty() ? "" : " ").append(info.remark).append("\n\n");
    writeForm<T, Form::Standard>(out, "");
    if constexpr (requires { Layout<T, Form::Bare>::fields; }) {
        writeForm<T, Form::Bare>(out, "Without the length:");
    }
    if constexpr (requires { Layout<T, Form::Short>::fields; }) {
        writeForm<T, Form::Short>(out, "The short form:");
    }
}

} // namespace

std::string protocolReference() {
    std::string out =
        "# MXTP protocol reference\n\nAll numbers are big-endian. Offsets count from the start of the "
        "header, the payload or the item; … stands where what is before is of varying size.\nSections are "
        "those of the specification, revision K, where "
        "no other revision is named.\n\n";
    out += referenceOverview();
    out += "\n## Header\n\nBytes 17 to 23 are reserved and zero in revisions E to K.\n\n";
    writeTable<Header, Form::Standard>(out);
    [&]<std::size_t... I>(std::index_sequence<I...>) {
        (writeMessage<std::variant_alternative_t<I + 1, Body>>(out), ...);
    }
    (std::make_index_sequence<std::variant_size_v<Body> - 1>{});
    return out;
}

} // namespace posewire::wire
