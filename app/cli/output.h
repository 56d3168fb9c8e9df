// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tl/expected.hpp>

#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace posewire::cli {

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
