// SPDX-License-Identifier: MIT
#include "core/log/byte_sink.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace posewire::log {
namespace {

struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

class FileSink final : public ByteSink {
public:
    FileSink(std::FILE* file, std::string name) : m_file(file), m_name(std::move(name)) {
        constexpr std::size_t bufferSize = std::size_t{1} << 18;
        std::setvbuf(m_file.get(), nullptr, _IOFBF, bufferSize);
    }

    tl::expected<void, FileError> write(std::span<const std::byte> bytes) override {
        return result(std::fwrite(bytes.data(), 1, bytes.size(), m_file.get()) == bytes.size());
    }
    tl::expected<void, FileError> flush() override { return result(std::fflush(m_file.get()) == 0); }
    [[nodiscard]] std::string name() const override { return m_name; }

private:
    [[nodiscard]] tl::expected<void, FileError> result(bool isWritten) const {
        if (isWritten) {
            return {};
        }
        const std::string why = errno == ENOSPC ? "the disk is full; make room or choose another disk"
                                                : std::string("writing failed (") + std::strerror(errno) +
                                                      "); is the disk still there?";
        return tl::unexpected(FileError{m_name + ": " + why + "; what was written before can be read"});
    }

    std::unique_ptr<std::FILE, Closer> m_file;
    std::string m_name;
};

} // namespace

tl::expected<std::unique_ptr<ByteSink>, FileError> createFile(const std::string& path) {
    errno = 0;
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (file == nullptr) {
        return tl::unexpected(FileError{path + ": cannot be written (" + std::strerror(errno) +
                                        "); choose another file or folder"});
    }
    return std::make_unique<FileSink>(file, path);
}

} // namespace posewire::log
