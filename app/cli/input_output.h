// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/byte_io.h"

#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace posewire::cli {

/// The file of that name; standard input for "-".
tl::expected<std::unique_ptr<log::ByteSource>, log::FileError> openInput(const std::string& path);

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

/// A file that is written from front to back, or standard output.
class Output {
public:
    /// "-" is standard output. The error is one line for the user.
    static tl::expected<Output, std::string> open(const std::string& path);
    static Output standard();

    void write(std::string_view text);
    void write(std::span<const std::byte> bytes);

    /// False once the reader has closed its end or a write has failed: no more output is needed.
    [[nodiscard]] bool isWanted() const { return m_isWanted; }

    /// Flushes, so that the reader sees it at once.
    void flush();

    /// Flushes and closes. The error is one line for the user; a reader that has left is not an error.
    tl::expected<void, std::string> finish();

    /// A whole file at once.
    static tl::expected<void, std::string> writeFile(const std::string& path, std::string_view text);

private:
    struct Closer {
        void operator()(std::FILE* file) const;
    };

    Output(std::FILE* file, std::string name) : m_file(file), m_name(std::move(name)) {}
    void note(bool isWritten);

    std::unique_ptr<std::FILE, Closer> m_file;
    std::string m_name;
    std::string m_failure;
    bool m_isWanted = true;
};

} // namespace posewire::cli
