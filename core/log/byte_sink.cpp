// SPDX-License-Identifier: MIT
#include "core/log/byte_sink.h"

#include <cerrno>
#include <cstring>
#include <fstream>

namespace posewire::log {
namespace {

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
    [[nodiscard]] std::string name() const override { return m_name; }

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
