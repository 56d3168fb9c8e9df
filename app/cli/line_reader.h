// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/byte_io.h"

#include <optional>
#include <string>
#include <string_view>

namespace posewire::cli {

/// Reads a byte source line by line.
class LineReader {
public:
    /// No datagram needs a longer line; longer ones are cut here, so that memory stays bounded.
    static constexpr std::size_t kLongestLine = std::size_t{4} << 20;

    explicit LineReader(log::ByteSource& source) : m_source(source) {}

    /// The next line without its line end, valid until the next call; empty at the end.
    tl::expected<std::optional<std::string_view>, log::FileError> next();

    /// Number of the last line, from 1.
    [[nodiscard]] std::size_t lineNumber() const { return m_lineNumber; }

private:
    tl::expected<bool, log::FileError> fill();

    log::ByteSource& m_source;
    std::string m_kept;
    std::size_t m_start = 0;
    std::size_t m_lineNumber = 0;
    bool m_isAtEnd = false;
};

} // namespace posewire::cli
