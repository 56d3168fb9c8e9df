// SPDX-License-Identifier: MIT
#include "core/log/byte_source.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <istream>
#include <system_error>

namespace posewire::log {

namespace {

class StreamSource final : public ByteSource {
public:
    StreamSource(std::istream& stream, std::string name) : m_stream(stream), m_name(std::move(name)) {}

    tl::expected<std::size_t, FileError> read(std::span<std::byte> into) override {
        m_stream.read(reinterpret_cast<char*>(into.data()), static_cast<std::streamsize>(into.size()));
        if (m_stream.bad()) {
            return tl::unexpected(
                FileError{m_name + ": reading failed; the device or the connection behind it may be gone"});
        }
        return static_cast<std::size_t>(m_stream.gcount());
    }
    [[nodiscard]] std::string name() const override { return m_name; }

private:
    std::istream& m_stream;
    std::string m_name;
};

class FileSource final : public ByteSource {
public:
    explicit FileSource(const std::string& path) : m_file(path, std::ios::binary), m_source(m_file, path) {}

    [[nodiscard]] bool isOpen() const { return m_file.is_open(); }
    tl::expected<std::size_t, FileError> read(std::span<std::byte> into) override {
        return m_source.read(into);
    }
    [[nodiscard]] std::string name() const override { return m_source.name(); }

private:
    std::ifstream m_file;
    StreamSource m_source;
};

} // namespace

tl::expected<std::unique_ptr<ByteSource>, FileError> openFile(const std::string& path) {
    std::error_code ignored;
    const auto kind = std::filesystem::status(path, ignored).type();
    if (kind == std::filesystem::file_type::not_found) {
        return tl::unexpected(FileError{path + ": no such file; check the name and the folder"});
    }
    if (kind == std::filesystem::file_type::directory) {
        return tl::unexpected(FileError{path + ": is a folder; name a file in it"});
    }
    errno = 0;
    auto source = std::make_unique<FileSource>(path);
    if (!source->isOpen()) {
        const std::string why =
            errno == EACCES ? "no permission to read it; ask its owner" : std::strerror(errno);
        return tl::unexpected(FileError{path + ": " + why});
    }
    return source;
}

std::unique_ptr<ByteSource> readingFrom(std::istream& stream, std::string name) {
    return std::make_unique<StreamSource>(stream, std::move(name));
}

} // namespace posewire::log
