// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/byte_io.h"
#include "core/log/output_file.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace posewire::cli {

/// Opens the file of that name; standard input for "-". Fails if standard output goes to the same file: that
/// would have no end. `isCancelled` as in log::openFile().
tl::expected<std::unique_ptr<log::ByteSource>, log::FileError> openInput(const std::string& path,
                                                                         log::IsCancelled isCancelled = {});

/// Says once that the first MB hold nothing of ours: a file may have no end.
class WatchedInput final : public log::ByteSource {
public:
    static constexpr std::uint64_t kPatience = std::uint64_t{64} << 20; ///< bytes

    /// `contents` is kept up while `source` is read; all outlive this.
    WatchedInput(log::ByteSource& source, const log::FileContents& contents,
                 std::function<void(const std::string&)> tell)
        : m_source(source), m_contents(contents), m_tell(std::move(tell)) {}

    tl::expected<std::size_t, log::FileError> read(std::span<std::byte> into) override;
    [[nodiscard]] std::string name() const override { return m_source.name(); }

private:
    log::ByteSource& m_source;
    const log::FileContents& m_contents;
    std::function<void(const std::string&)> m_tell; ///< empty once it was called
    std::uint64_t m_bytes = 0;
};

/// Why standard output could not be written, by its errno, as one line for the user.
[[nodiscard]] std::string standardOutputFailure(int error);

class LineReader {
public:
    /// No datagram needs a longer line; reading ends there with an error, so that memory stays bounded.
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

/// A file that is written from front to back and is there whole or not at all, or standard output.
class Output {
public:
    /// "-" is standard output. The error is one line for the user.
    static tl::expected<Output, std::string> open(const std::string& path, const log::OutputRules& rules);
    static Output standard();

    void write(std::string_view text);
    void write(std::span<const std::byte> bytes);

    /// False once the reader has closed its end or a write has failed: no more output is needed.
    [[nodiscard]] bool isWanted() const { return m_isWanted; }

    /// Flushes, so that the reader sees it at once.
    void flush();

    /// Call last; no file is created otherwise. The error is one line for the user; a reader that has left is
    /// not an error.
    tl::expected<void, std::string> finish();

    static tl::expected<void, std::string> writeFile(const std::string& path, const log::OutputRules& rules,
                                                     std::string_view text);

private:
    explicit Output(std::unique_ptr<log::ByteSink> sink) : m_sink(std::move(sink)) {}
    void note(const tl::expected<void, log::FileError>& result);

    std::unique_ptr<log::ByteSink> m_sink;
    std::string m_failure;
    bool m_isWanted = true;
};

} // namespace posewire::cli
