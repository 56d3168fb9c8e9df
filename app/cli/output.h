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
    /// Takes standard output for "-". Fails with one line for the user.
    static tl::expected<Output, std::string> open(const std::string& path);
    static Output standard();

    void write(std::string_view text);
    void write(std::span<const std::byte> bytes);

    /// False once the reader at the other end has gone or a write has failed: what follows is not needed.
    [[nodiscard]] bool isWanted() const { return m_isWanted; }

    /// What was written can be seen at once.
    void flush();

    /// Hands everything over. Fails with one line for the user; a reader that has gone is no failure.
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
