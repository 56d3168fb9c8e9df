// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/input_output.h"

#include "app/mvnx/mvnx_source.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace posewire::cli {
namespace {

/// As the C library buffers it: by line on a terminal.
class StandardOutput final : public log::ByteSink {
public:
    tl::expected<void, log::FileError> write(std::span<const std::byte> bytes) override {
        return result(std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size());
    }
    tl::expected<void, log::FileError> flush() override { return result(std::fflush(stdout) == 0); }

private:
    static tl::expected<void, log::FileError> result(bool isWritten) {
        using Kind = log::FileError::Kind;
        if (isWritten) {
            return {};
        }
        const int error = errno;
        return tl::unexpected(
            log::FileError{standardOutputFailure(error), error == EPIPE ? Kind::Unread : Kind::Failed});
    }
};

} // namespace

std::string standardOutputFailure(int error) {
    return std::string("standard output: writing failed (") + std::strerror(error) + "); is the disk full?";
}

tl::expected<std::unique_ptr<log::ByteSource>, log::FileError> openInput(const std::string& path,
                                                                         log::IsCancelled isCancelled) {
    const std::string standardOutput(log::kStandardOutput);
    if (const auto checked = log::checkOutput(standardOutput, {.inUse = {path}}); !checked) {
        return tl::unexpected(checked.error());
    }
    if (path == "-") {
        return std::make_unique<mvnx::MvnxSource>(log::openStandardInput(std::move(isCancelled)));
    }
    return mvnx::openFile(path, std::move(isCancelled));
}

tl::expected<std::size_t, log::FileError> WatchedInput::read(std::span<std::byte> into) {
    if (m_tell && m_bytes >= kPatience && m_contents.datagrams == 0) {
        m_tell(name() + ": nothing of ours in its first " + std::to_string(m_bytes >> 20U) +
               " MB; still looking, Ctrl+C ends it");
        m_tell = {};
    }
    auto count = m_source.read(into);
    m_bytes += count.value_or(0);
    return count;
}

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
        if (std::min(end, rest.size()) > kLongestLine) {
            return tl::unexpected(log::FileError{m_source.name() + ": line " +
                                                 std::to_string(m_lineNumber + 1) +
                                                 " is longer than 4 MiB, the most that is read; is this JSON "
                                                 "Lines of decode?"});
        }
        if (isWhole || (m_isAtEnd && !rest.empty())) {
            std::string_view line = rest.substr(0, isWhole ? end : rest.size());
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

tl::expected<Output, std::string> Output::open(const std::string& path, const log::OutputRules& rules) {
    if (path == "-") {
        return standard();
    }
    auto sink = log::createWholeFile(path, rules);
    if (!sink) {
        return tl::unexpected(sink.error().text);
    }
    return Output(std::move(*sink));
}

Output Output::standard() {
    return Output(std::make_unique<StandardOutput>());
}

void Output::write(std::string_view text) {
    write(std::as_bytes(std::span(text)));
}

void Output::write(std::span<const std::byte> bytes) {
    if (m_isWanted) {
        note(m_sink->write(bytes));
    }
}

void Output::flush() {
    if (m_isWanted) {
        note(m_sink->flush());
    }
}

tl::expected<void, std::string> Output::finish() {
    if (m_isWanted) {
        note(m_sink->finish());
    }
    if (!m_failure.empty()) {
        return tl::unexpected(m_failure);
    }
    return {};
}

tl::expected<void, std::string> Output::writeFile(const std::string& path, const log::OutputRules& rules,
                                                  std::string_view text) {
    auto file = open(path, rules);
    if (!file) {
        return tl::unexpected(file.error());
    }
    file->write(text);
    return file->finish();
}

void Output::note(const tl::expected<void, log::FileError>& result) {
    if (result) {
        return;
    }
    m_isWanted = false;
    if (result.error().kind != log::FileError::Kind::Unread) {
        m_failure = result.error().text;
    }
}

} // namespace posewire::cli
