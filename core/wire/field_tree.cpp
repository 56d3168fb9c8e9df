// SPDX-License-Identifier: MIT
#include "core/wire/field_tree.h"

#include "core/wire/checks.h"
#include "core/wire/payload.h"

#include <charconv>

namespace posewire::wire {
namespace {

std::string shown(float value) {
    std::array<char, 48> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
    return {buffer.data(), end};
}

template <std::size_t N>
std::string shown(const std::array<float, N>& values) {
    std::string text;
    for (const float value : values) {
        text += (text.empty() ? "" : "  ") + shown(value);
    }
    return text;
}

template <std::size_t N>
std::string shown(const std::array<char, N>& characters) {
    return {characters.data(), N};
}

std::string shown(const std::string& text) {
    return text;
}

std::string shown(std::integral auto value) {
    return std::to_string(value);
}

std::string hexadecimal(std::uint32_t value) {
    std::array<char, 8> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, 16).ptr;
    return "0x" + std::string(buffer.data(), end);
}

/// Writes every field down.
class TreeWriter {
public:
    static constexpr bool kListens = true;

    explicit TreeWriter(FieldTree& tree) : m_tree(tree) {}

    template <class Value>
    void field(const About& about, std::size_t offset, std::size_t size, const Value& value) {
        FieldNode& node = add(std::string(about.name), about, offset, size);
        if constexpr (std::is_same_v<Value, std::uint32_t>) {
            node.value = about.unit == Unit::Flags ? hexadecimal(value) : shown(value);
        } else {
            node.value = shown(value);
        }
    }
    void count(const About& about, std::size_t offset, std::size_t count) {
        add(std::string(about.name) + " count",
            {"", Unit::Count, "number of items that follow", about.section}, offset, 4)
            .value = std::to_string(count);
    }
    void beginGroup(std::string name, const About& about, std::size_t offset) {
        add(std::move(name), about, offset, 0);
        m_parents.push_back(static_cast<std::int32_t>(m_tree.nodes.size()) - 1);
    }
    void endGroup(std::size_t offset) {
        FieldNode& group = m_tree.nodes[static_cast<std::size_t>(m_parents.back())];
        group.length = static_cast<std::uint32_t>(offset) - group.offset;
        m_parents.pop_back();
    }
    void beginList(const About& about, std::size_t offset, std::size_t) {
        m_section = about.section;
        beginGroup(std::string(about.name), about, offset);
    }
    void endList(std::size_t offset) { endGroup(offset); }
    void beginItem(std::size_t index, std::size_t offset) {
        beginGroup(std::to_string(index + 1), {"", Unit::None, "", m_section}, offset);
    }
    void endItem(std::size_t offset) { endGroup(offset); }
    void rest(std::size_t offset, std::size_t size) {
        add("bytes", {"", Unit::None, "no field stands on these bytes", ""}, offset, size).value =
            std::to_string(size);
    }
    /// Ends the groups that a fault left open.
    void close(std::size_t offset) {
        while (!m_parents.empty()) {
            endGroup(offset);
        }
    }

private:
    FieldNode& add(std::string name, const About& about, std::size_t offset, std::size_t size) {
        const std::int32_t parent = m_parents.empty() ? -1 : m_parents.back();
        return m_tree.nodes.emplace_back(FieldNode{std::move(name), "", static_cast<std::uint32_t>(offset),
                                                   static_cast<std::uint32_t>(size), parent, about.unit,
                                                   about.text, about.section});
    }

    FieldTree& m_tree;
    std::vector<std::int32_t> m_parents;
    std::string_view m_section;
};

/// As much of the header as there is.
void readHeader(Bytes bytes, TreeWriter& writer) {
    Header header;
    Cursor cursor{bytes.first(std::min(bytes.size(), kHeaderSize)), 0, 0, {}};
    writer.beginGroup("header", {"", Unit::None, "24 bytes, the same for all types", "2.4.1"}, 0);
    readLayout<Header, Form::Standard>(cursor, header, writer);
    writer.endGroup(cursor.offset);
}

} // namespace

std::int32_t FieldTree::nodeAt(std::uint32_t offset) const {
    std::int32_t found = -1;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (offset >= nodes[i].offset && offset - nodes[i].offset < nodes[i].length) {
            found = static_cast<std::int32_t>(i);
        }
    }
    return found;
}

FieldTree fieldTree(Bytes bytes) {
    FieldTree tree;
    TreeWriter writer(tree);
    if (startsDatagram(bytes)) {
        readHeader(bytes, writer);
    }
    const auto header = decodeHeader(bytes);
    if (!header) {
        tree.fault = header.error();
        return tree;
    }
    Datagram datagram;
    datagram.header = *header;
    Cursor cursor = payloadCursor(bytes, *header);
    if (readBody(cursor, datagram, writer)) {
        checkValues(bytes, datagram);
        if (bytes.size() > cursor.bytes.size()) {
            writer.rest(cursor.bytes.size(), bytes.size() - cursor.bytes.size());
        }
    } else {
        tree.fault = cursor.error;
        writer.close(cursor.offset);
    }
    tree.notices = std::move(datagram.notices);
    return tree;
}

} // namespace posewire::wire
