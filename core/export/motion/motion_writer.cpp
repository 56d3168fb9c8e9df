// SPDX-License-Identifier: MIT
#include "core/export/motion/motion_writer.h"

#include <charconv>

namespace posewire::exporting {
namespace {

constexpr std::size_t kPiece = std::size_t{256} << 10;

} // namespace

void MotionOutput::write(std::string_view bytes) {
    m_buffer += bytes;
    if (m_buffer.size() >= kPiece) {
        flush();
    }
}

void MotionOutput::flush() {
    if (m_result && !m_buffer.empty()) {
        m_result = m_sink->write(std::as_bytes(std::span(m_buffer)));
    }
    m_buffer.clear();
}

void MotionOutput::fail(std::string text) {
    if (m_result) {
        m_result = tl::unexpected(log::FileError{std::move(text)});
    }
}

tl::expected<void, log::FileError> MotionOutput::finish() {
    flush();
    if (m_result) {
        m_result = m_sink->finish();
    }
    return m_result;
}

void appendNumber(double value, std::string& text) {
    std::array<char, 32> digits{};
    const auto end =
        std::to_chars(digits.data(), digits.data() + digits.size(), static_cast<float>(value)).ptr;
    text.append(digits.data(), end);
}

void appendFixed(double value, int decimals, std::string& text) {
    std::array<char, 400> digits{}; // the largest double has 309 digits before the point
    const auto end =
        std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed, decimals)
            .ptr;
    text.append(digits.data(), end);
}

} // namespace posewire::exporting
