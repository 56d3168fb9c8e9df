// SPDX-License-Identifier: MIT
#include "core/export/motion/c3d_parameters.h"

#include <algorithm>
#include <bit>

namespace posewire::exporting {
namespace {

enum class Type : std::int8_t { Text = -1, Integer = 2, Real = 4 };

void appendByte(std::size_t value, std::string& bytes) {
    bytes += static_cast<char>(static_cast<unsigned char>(value));
}

template <class Number>
void appendLow(Number bits, std::string& bytes) {
    for (std::size_t i = 0; i < sizeof(bits); ++i) {
        appendByte(static_cast<std::size_t>(bits >> (8 * i)) & 0xff, bytes);
    }
}

std::string contentOf(Type type, std::initializer_list<std::size_t> dimensions) {
    std::string content;
    appendByte(static_cast<std::size_t>(type), content);
    appendByte(dimensions.size(), content);
    for (const std::size_t size : dimensions) {
        appendByte(size, content);
    }
    return content;
}

} // namespace

void appendC3d(std::int16_t value, std::string& bytes) {
    appendLow(static_cast<std::uint16_t>(value), bytes);
}

void appendC3d(float value, std::string& bytes) {
    appendLow(std::bit_cast<std::uint32_t>(value), bytes);
}

void C3dParameters::addItem(std::string_view name, std::int8_t group, std::string_view content) {
    appendByte(name.size(), m_items);
    appendByte(static_cast<std::size_t>(group), m_items);
    m_items += name;
    // To the next item, from here on; then an empty description.
    appendC3d(static_cast<std::int16_t>(sizeof(std::int16_t) + content.size() + 1), m_items);
    m_items += content;
    appendByte(0, m_items);
}

void C3dParameters::beginGroup(std::string_view name) {
    ++m_group;
    addItem(name, static_cast<std::int8_t>(-m_group), {});
}

void C3dParameters::add(std::string_view name, std::span<const std::int16_t> values) {
    std::string content =
        values.size() == 1 ? contentOf(Type::Integer, {}) : contentOf(Type::Integer, {values.size()});
    for (const std::int16_t value : values) {
        appendC3d(value, content);
    }
    addItem(name, m_group, content);
}

void C3dParameters::add(std::string_view name, float value) {
    std::string content = contentOf(Type::Real, {});
    appendC3d(value, content);
    addItem(name, m_group, content);
}

void C3dParameters::add(std::string_view name, std::span<const std::string> texts) {
    std::size_t length = 0;
    for (const std::string& text : texts) {
        length = std::max(length, std::min(text.size(), kMostText));
    }
    std::string content = contentOf(Type::Text, {length, texts.size()});
    for (const std::string& text : texts) {
        const std::string_view kept = std::string_view(text).substr(0, length);
        content.append(kept).append(length - kept.size(), ' ');
    }
    addItem(name, m_group, content);
}

void C3dParameters::add(std::string_view name, std::string_view text) {
    const std::string_view kept = text.substr(0, kMostText);
    std::string content = contentOf(Type::Text, {kept.size()});
    addItem(name, m_group, content.append(kept));
}

std::string C3dParameters::section() const {
    constexpr std::size_t intel = 84;
    std::string bytes;
    appendByte(1, bytes);
    appendByte(0x50, bytes);
    appendByte(blocks(), bytes);
    appendByte(intel, bytes);
    bytes += m_items;
    bytes.resize(blocks() * kBlock, '\0'); // an item without a name ends them
    return bytes;
}

std::size_t C3dParameters::blocks() const {
    constexpr std::size_t head = 4;
    constexpr std::size_t end = 4;
    return (head + m_items.size() + end + kBlock - 1) / kBlock;
}

} // namespace posewire::exporting
