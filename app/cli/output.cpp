// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/output.h"

#include <cerrno>
#include <cstring>

namespace posewire::cli {

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
