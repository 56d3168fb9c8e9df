// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/byte_source.h"

namespace posewire::log {

/// Where bytes go in order. After a failure nothing more is to be written.
class ByteSink {
public:
    virtual ~ByteSink() = default;

    virtual tl::expected<void, FileError> write(std::span<const std::byte> bytes) = 0;

    /// What was written is in the hands of the system: it survives the end of this process.
    virtual tl::expected<void, FileError> flush() = 0;

    /// For messages: the name of the file.
    [[nodiscard]] virtual std::string name() const = 0;
};

/// A file that is written from the start. Fails where it cannot be; later failures, such as a full disk, come
/// from write() and flush().
tl::expected<std::unique_ptr<ByteSink>, FileError> createFile(const std::string& path);

} // namespace posewire::log
