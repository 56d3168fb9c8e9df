// SPDX-License-Identifier: MIT
#pragma once

#include <tl/expected.hpp>

#include <cstddef>
#include <iosfwd>
#include <memory>
#include <span>
#include <string>

namespace posewire::log {

/// Why a file cannot be read or written: what, where and what to do, in one line for the user.
struct FileError {
    std::string text;
};

/// Bytes in order, from wherever.
class ByteSource {
public:
    virtual ~ByteSource() = default;

    /// Fills the front of `into` and returns how much; 0 only at the end.
    virtual tl::expected<std::size_t, FileError> read(std::span<std::byte> into) = 0;

    /// For messages: the name of the file, "standard input".
    [[nodiscard]] virtual std::string name() const = 0;
};

/// Fails where there is no such file, it is a folder, or may not be read.
tl::expected<std::unique_ptr<ByteSource>, FileError> openFile(const std::string& path);

/// Reads from a stream that belongs to the caller: standard input, a string in a test.
std::unique_ptr<ByteSource> readingFrom(std::istream& stream, std::string name);

/// Where bytes go in order. After a failure nothing more is to be written.
class ByteSink {
public:
    virtual ~ByteSink() = default;

    virtual tl::expected<void, FileError> write(std::span<const std::byte> bytes) = 0;

    /// What was written is in the hands of the system: it survives the end of this process.
    virtual tl::expected<void, FileError> flush() = 0;
};

/// A file that is written from the start. Fails where it cannot be; later failures, such as a full disk, come
/// from write() and flush().
tl::expected<std::unique_ptr<ByteSink>, FileError> createFile(const std::string& path);

} // namespace posewire::log
