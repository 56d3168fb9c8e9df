// SPDX-License-Identifier: MIT
#include "core/wire/field_tree.h"

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
    TreeWriter(FieldTree& tree, FieldDetail detail)
        : m_tree(tree), m_hasParts(detail == FieldDetail::Parts) {}

    [[nodiscard]] bool wantsCuts() const { return m_hasParts; }

    template <class Value>
    void field(const About& about, std::size_t offset, std::size_t size, const Value& value) {
        FieldNode& node = add(about, offset, size);
        node.scalar = kScalar<Value>;
        if constexpr (std::is_integral_v<Value>) {
            const bool isFlags = about.unit == Unit::Flags;
            node.value = isFlags ? hexadecimal(static_cast<std::uint32_t>(value)) : shown(value);
        } else {
            node.value = shown(value);
        }
        if constexpr (std::is_arithmetic_v<Value>) {
            node.number = static_cast<double>(value);
        }
        if (m_hasParts) {
            m_parents.push_back(static_cast<std::int32_t>(m_tree.nodes.size()) - 1);
            for (const FieldPart& declared : about.parts) {
                addPart(declared, about, offset, value);
            }
            divide(about, offset, size, value);
            m_parents.pop_back();
        }
    }
    void count(const About& about, std::size_t offset, std::size_t count) {
        FieldNode& node =
            add({about.name, Unit::Count, "number of items that follow", about.section}, offset, 4);
        node.name += " count";
        node.scalar = Scalar::Uint32;
        node.value = std::to_string(count);
        node.number = static_cast<double>(count);
    }
    void cut(const About& about, std::size_t offset, std::size_t present, const WireError& error) {
        if (m_tree.cutNode >= 0) {
            return;
        }
        FieldNode& node = add(about, offset, present);
        node.kind = NodeKind::Cut;
        m_tree.cutNode = static_cast<std::int32_t>(m_tree.nodes.size()) - 1;
        m_tree.cutError = error;
    }
    void beginGroup(const About& about, std::size_t offset) {
        add(about, offset, 0).kind = NodeKind::Group;
        m_parents.push_back(static_cast<std::int32_t>(m_tree.nodes.size()) - 1);
    }
    void endGroup(std::size_t offset) {
        FieldNode& group = m_tree.nodes[static_cast<std::size_t>(m_parents.back())];
        group.length = static_cast<std::uint32_t>(offset) - group.offset;
        m_parents.pop_back();
    }
    void beginList(const About& about, std::size_t offset, std::size_t count) {
        m_list = about;
        beginGroup(about, offset);
        m_tree.nodes.back().index = static_cast<std::uint32_t>(count);
    }
    void beginItem(std::size_t index, std::size_t offset) {
        beginGroup({std::to_string(index + 1), Unit::None, "", m_list.section, m_list.refersTo}, offset);
        m_tree.nodes.back().kind = NodeKind::Item;
        m_tree.nodes.back().index = static_cast<std::uint32_t>(index);
    }
    void rest(std::size_t offset, std::size_t size) {
        FieldNode& node = add({"bytes", Unit::None, "no field has these bytes", ""}, offset, size);
        node.value = std::to_string(size);
        node.kind = NodeKind::Unread;
    }
    /// Ends the groups that are open, as a fault leaves them.
    void close() {
        while (!m_parents.empty()) {
            endGroup(m_end);
        }
    }
    /// What a fault left unread, once all groups are closed.
    void unread(std::size_t size) {
        if (m_end < size) {
            FieldNode& node =
                add({"unread", Unit::None, "not read because of the fault before", ""}, m_end, size - m_end);
            node.value = std::to_string(size - m_end) + " bytes";
            node.kind = NodeKind::Unread;
        }
    }

private:
    FieldNode& part(const About& about, std::size_t offset, std::size_t size) {
        FieldNode& node = add(about, offset, size);
        node.kind = NodeKind::Part;
        return node;
    }
    template <class Value>
    void addPart(const FieldPart& declared, const About& about, std::size_t offset, const Value& value) {
        FieldNode& node = part({declared.name, declared.unit, declared.text, about.section},
                               offset + declared.offset, declared.size);
        if constexpr (kScalar<Value> == Scalar::Characters) {
            node.scalar = Scalar::Characters;
            node.value = std::string(value.data() + declared.offset, declared.size);
        } else if constexpr (std::is_unsigned_v<Value>) {
            const auto bits = static_cast<unsigned>(value) & declared.bits;
            node.scalar = kScalar<Value>;
            node.value = !declared.isFlag() ? std::to_string(bits) : bits != 0 ? "yes" : "no";
            node.number = declared.isFlag() ? node.number : bits;
        }
    }
    template <std::size_t N>
    void divide(const About& about, std::size_t offset, std::size_t, const std::array<float, N>& values) {
        m_tree.nodes.back().components = N;
        for (std::size_t i = 0; i < N; ++i) {
            FieldNode& node = part(about, offset + 4 * i, 4);
            node.name = componentNames(N)[i];
            node.scalar = Scalar::Float32;
            node.value = shown(values[i]);
            node.number = values[i];
        }
    }
    void divide(const About& about, std::size_t offset, std::size_t size, const std::string& text) {
        std::size_t at = offset;
        if (size == text.size() + 4) {
            FieldNode& length =
                part({"length", Unit::ByteCount, "bytes of the text that follow", about.section}, at, 4);
            length.scalar = Scalar::Int32;
            length.value = std::to_string(text.size());
            length.number = static_cast<double>(text.size());
            at += 4;
        }
        if (about.unit != Unit::TagLines) {
            return;
        }
        for (std::size_t begin = 0; begin < text.size();) {
            const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
            const std::size_t colon = std::min(text.find(':', begin), end);
            const std::size_t stop = text[end - 1] == '\n' ? end - 1 : end;
            FieldNode& line = part({std::string_view(text).substr(begin, std::min(colon, stop) - begin),
                                    Unit::None, "one tag of the text", about.section},
                                   at + begin, end - begin);
            line.value = colon < stop ? text.substr(colon + 1, stop - colon - 1) : std::string();
            begin = end;
        }
    }
    void divide(const About&, std::size_t, std::size_t, const auto&) {}

    FieldNode& add(const About& about, std::size_t offset, std::size_t size) {
        const std::int32_t parent = m_parents.empty() ? -1 : m_parents.back();
        m_end = std::max(m_end, offset + size);
        FieldNode& node = m_tree.nodes.emplace_back();
        node.name = about.name;
        node.offset = static_cast<std::uint32_t>(offset);
        node.length = static_cast<std::uint32_t>(size);
        node.parent = parent;
        node.unit = about.unit;
        node.refersTo = about.refersTo;
        node.text = about.text;
        node.section = about.section;
        return node;
    }

    FieldTree& m_tree;
    std::vector<std::int32_t> m_parents;
    About m_list;          ///< that is being read
    std::size_t m_end = 0; ///< one past the last byte that has a node
    bool m_hasParts;
};

/// As much of the header as there is.
void readHeader(Bytes bytes, TreeWriter& writer) {
    Header header;
    Cursor cursor{bytes.first(std::min(bytes.size(), kHeaderSize)), 0, 0, {}};
    writer.beginGroup({"header", Unit::None, "24 bytes, the same for all types", "2.4.1"}, 0);
    readLayout<Header, Form::Standard>(cursor, header, writer);
    writer.close();
}

void writeTree(Bytes bytes, FieldTree& tree, TreeWriter& writer) {
    if (startsDatagram(bytes)) {
        readHeader(bytes, writer);
    }
    const auto header = decodeHeader(bytes);
    if (!header) {
        tree.fault = header.error();
        return;
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
        writer.close();
    }
    tree.notices = std::move(datagram.notices);
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

std::string FieldTree::path(std::int32_t node) const {
    std::string path;
    for (; node >= 0; node = nodes[static_cast<std::size_t>(node)].parent) {
        const FieldNode& step = nodes[static_cast<std::size_t>(node)];
        if (step.kind == NodeKind::Item) {
            path.insert(0, '[' + std::to_string(step.index) + ']');
        } else {
            path.insert(0, '.' + step.name);
        }
    }
    return path.empty() ? path : path.substr(1);
}

FieldTree fieldTree(Bytes bytes, FieldDetail detail) {
    FieldTree tree;
    TreeWriter writer(tree, detail);
    writeTree(bytes, tree, writer);
    if (detail == FieldDetail::Parts) {
        writer.unread(bytes.size());
    }
    return tree;
}

} // namespace posewire::wire
