// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/byte_io.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

/// The one place that decides which files are written, for every command and for the window.
namespace posewire::log {

/// What a file that is to be written may be.
struct OutputRules {
    bool mayReplace = false; ///< a file that exists; pipes and devices such as /dev/null need no leave
    /// Files in use, "-" for standard input: never written over, whatever names and links lead to them.
    std::vector<std::string> inUse{};
    /// Asked again and again while a pipe has nobody who reads it: whether that is waited for any longer.
    /// Without it opening such a pipe fails at once.
    std::function<bool()> waitsForReader{};
};

/// Whether the file may be written as things are: to be asked before long work.
tl::expected<void, FileError> checkOutput(const std::string& path, const OutputRules& rules);

/// A file that grows where it is, such as a recording: what was flushed is there whatever happens. Later
/// failures, such as a full disk, come from write(), flush(), sync() and finish(). A pipe that nobody reads
/// is FileError::Kind::Unread.
tl::expected<std::unique_ptr<ByteSink>, FileError> createFile(const std::string& path,
                                                              const OutputRules& rules = {});

/// A file that is there whole or not at all: it grows beside its name and gets that with finish(), once it is
/// on the disk. Without finish() nothing is left of it. What a link leads to is replaced, not the link.
tl::expected<std::unique_ptr<ByteSink>, FileError> createWholeFile(const std::string& path,
                                                                   const OutputRules& rules = {});

/// createWholeFile() at once.
tl::expected<void, FileError> writeWholeFile(const std::string& path, std::span<const std::byte> bytes,
                                             const OutputRules& rules = {});

/// The same with the bytes of another file.
tl::expected<void, FileError> copyFile(const std::string& from, const std::string& to,
                                       const OutputRules& rules = {});

} // namespace posewire::log
