// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/input_output.h"

#include <cerrno>
#include <cstring>
#include <iostream>

namespace posewire::cli {

tl::expected<std::unique_ptr<log::ByteSource>, log::FileError> openInput(const std::string& path) {
    if (path == "-") {
        return log::readingFrom(std::cin, "standard input");
    }
    return log::openFile(path);
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

void Output::Closer::operator()(std::FILE* file) const {
    if (file != stdout) {
        std::fclose(file);
    }
}

tl::expected<Output, std::string> Output::open(const std::string& path) {
    if (path == "-") {
        return standard();
    }
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (file == nullptr) {
        return tl::unexpected(path + ": cannot be written (" + std::strerror(errno) +
                              "); choose another file or folder");
    }
    return Output(file, path);
}

Output Output::standard() {
    return {stdout, "standard output"};
}

void Output::write(std::string_view text) {
    note(std::fwrite(text.data(), 1, text.size(), m_file.get()) == text.size());
}

void Output::write(std::span<const std::byte> bytes) {
    note(std::fwrite(bytes.data(), 1, bytes.size(), m_file.get()) == bytes.size());
}

void Output::flush() {
    note(std::fflush(m_file.get()) == 0);
}

tl::expected<void, std::string> Output::finish() {
    flush();
    if (!m_failure.empty()) {
        return tl::unexpected(m_failure);
    }
    return {};
}

tl::expected<void, std::string> Output::writeFile(const std::string& path, std::string_view text) {
    auto file = open(path);
    if (!file) {
        return tl::unexpected(file.error());
    }
    file->write(text);
    return file->finish();
}

void Output::note(bool isWritten) {
    if (isWritten || !m_isWanted) {
        return;
    }
    m_isWanted = false;
    if (errno != EPIPE) {
        m_failure = m_name + ": writing failed (" + std::strerror(errno) + "); is the disk full?";
    }
}

} // namespace posewire::cli
