// SPDX-License-Identifier: MIT
#include "core/log/byte_io.h"

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
    /// `owned` may be null: then the stream belongs to somebody else.
    StreamSource(std::istream& stream, std::string name, std::unique_ptr<std::istream> owned = {})
        : m_stream(stream), m_name(std::move(name)), m_owned(std::move(owned)) {}

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
    std::unique_ptr<std::istream> m_owned;
};

class FileSink final : public ByteSink {
public:
    FileSink(std::ofstream file, std::string name) : m_file(std::move(file)), m_name(std::move(name)) {}

    tl::expected<void, FileError> write(std::span<const std::byte> bytes) override {
        m_file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        return result();
    }
    tl::expected<void, FileError> flush() override {
        m_file.flush();
        return result();
    }

private:
    [[nodiscard]] tl::expected<void, FileError> result() const {
        if (m_file.good()) {
            return {};
        }
        const std::string why = errno == ENOSPC ? "the disk is full; make room or choose another disk"
                                                : std::string("writing failed (") + std::strerror(errno) +
                                                      "); is the disk still there?";
        return tl::unexpected(FileError{m_name + ": " + why + "; what was written before can be read"});
    }

    std::ofstream m_file;
    std::string m_name;
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
    auto file = std::make_unique<std::ifstream>(path, std::ios::binary);
    if (!file->is_open()) {
        const std::string why =
            errno == EACCES ? "no permission to read it; ask its owner" : std::strerror(errno);
        return tl::unexpected(FileError{path + ": " + why});
    }
    std::istream& stream = *file;
    return std::make_unique<StreamSource>(stream, path, std::move(file));
}

std::unique_ptr<ByteSource> readingFrom(std::istream& stream, std::string name) {
    return std::make_unique<StreamSource>(stream, std::move(name));
}

tl::expected<std::unique_ptr<ByteSink>, FileError> createFile(const std::string& path) {
    errno = 0;
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    if (!file.is_open()) {
        return tl::unexpected(FileError{path + ": cannot be written (" + std::strerror(errno) +
                                        "); choose another file or folder"});
    }
    return std::make_unique<FileSink>(std::move(file), path);
}

} // namespace posewire::log
