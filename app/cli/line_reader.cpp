// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/line_reader.h"

namespace posewire::cli {

tl::expected<bool, log::FileError> LineReader::fill() {
    constexpr std::size_t step = std::size_t{64} << 10;
    m_kept.erase(0, m_start);
    m_start = 0;
    const std::size_t before = m_kept.size();
    m_kept.resize(before + step);
    const auto count = m_source.read(std::as_writable_bytes(std::span(m_kept)).subspan(before));
    m_kept.resize(before + count.value_or(0));
    if (!count) {
        return tl::unexpected(count.error());
    }
    return *count != 0;
}

tl::expected<std::optional<std::string_view>, log::FileError> LineReader::next() {
    std::size_t searched = 0;
    while (true) {
        const std::string_view rest = std::string_view(m_kept).substr(m_start);
        const std::size_t end = rest.find('\n', searched);
        const bool isWhole = end != std::string_view::npos;
        if (isWhole || rest.size() >= kLongestLine || (m_isAtEnd && !rest.empty())) {
            std::string_view line = rest.substr(0, isWhole ? end : kLongestLine);
            m_start += line.size() + (isWhole ? 1 : 0);
            ++m_lineNumber;
            if (line.ends_with('\r')) {
                line.remove_suffix(1);
            }
            return line;
        }
        if (m_isAtEnd) {
            return std::nullopt;
        }
        searched = rest.size();
        const auto isMore = fill();
        if (!isMore) {
            return tl::unexpected(isMore.error());
        }
        m_isAtEnd = !*isMore;
    }
}

} // namespace posewire::cli
