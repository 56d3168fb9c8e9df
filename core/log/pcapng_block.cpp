// SPDX-License-Identifier: MIT
#include "core/log/pcapng_block.h"

#include <array>

namespace posewire::log {

PcapngBlock::PcapngBlock(std::vector<std::byte>& buffer, PcapngBlockType type) : m_buffer(buffer) {
    m_buffer.clear();
    number(static_cast<std::uint32_t>(type), 4);
    number(0, 4); // the length, once it is known
}

void PcapngBlock::number(std::uint64_t value, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
        m_buffer.push_back(static_cast<std::byte>(value >> 8 * i & 0xffU));
    }
}

void PcapngBlock::halves(std::uint64_t value) {
    number(value >> 32, 4);
    number(value & 0xffffffffU, 4);
}

void PcapngBlock::padded(std::span<const std::byte> bytes) {
    m_buffer.insert(m_buffer.end(), bytes.begin(), bytes.end());
    m_buffer.resize((m_buffer.size() + 3) / 4 * 4);
}

void PcapngBlock::option(PcapngOption code, std::string_view text) {
    if (!text.empty()) {
        option(code, std::as_bytes(std::span(text)));
    }
}

void PcapngBlock::option(PcapngOption code, std::span<const std::byte> bytes) {
    m_hasOptions = true;
    number(static_cast<std::uint16_t>(code), 2);
    number(bytes.size(), 2);
    padded(bytes);
}

void PcapngBlock::option(PcapngOption code, std::uint64_t value) {
    std::array<std::byte, 8> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        bytes[i] = static_cast<std::byte>(value >> 8 * i & 0xffU);
    }
    option(code, bytes);
}

void PcapngBlock::finish() {
    if (m_hasOptions) {
        number(0, 4);
    }
    const std::size_t length = m_buffer.size() + 4;
    number(length, 4);
    for (std::size_t i = 0; i < 4; ++i) {
        m_buffer[4 + i] = static_cast<std::byte>(length >> 8 * i & 0xffU);
    }
}

} // namespace posewire::log
