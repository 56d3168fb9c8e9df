// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/byte_io.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

/// The one place that decides which files are written, for every command and for the window.
namespace posewire::log {

/// As a path, the standard output of this process on every system: appended to, never replaced.
inline constexpr std::string_view kStandardOutput = "/dev/stdout";

/// Limits on a file to be written.
struct OutputRules {
    bool mayReplace = false; ///< an existing file; pipes and devices such as /dev/null need no permission
    /// Files in use, "-" for standard input: never written over, whatever names and links lead to them.
    std::vector<std::string> inUse{};
    /// The file grows: other programs are kept from writing to it, and writing fails as Displaced once its
    /// name leads elsewhere.
    bool isWatched = true;
};

/// Permissions of the files that are made from now on, in octal; 0600 at first, as motion is that of people.
/// A file that is replaced keeps its own. Returns in one line what is wrong with the text, or nothing.
std::string setFileMode(const std::string& octal);

/// Fails if the file may not be written at present: call it before long work.
tl::expected<void, FileError> checkOutput(const std::string& path, const OutputRules& rules);

/// A file that grows in place, such as a recording: what was flushed is there whatever happens. Later
/// failures, such as a full disk, come from write(), flush(), sync() and finish(). Fails for a pipe without a
/// reader.
tl::expected<std::unique_ptr<ByteSink>, FileError> createFile(const std::string& path,
                                                              const OutputRules& rules = {});

/// A file that is there whole or not at all: it grows beside its name and gets that with finish(), once it is
/// on the disk. Without finish() nothing is left of it. What a link leads to is replaced, not the link.
tl::expected<std::unique_ptr<ByteSink>, FileError> createWholeFile(const std::string& path,
                                                                   const OutputRules& rules = {});

/// Creates, writes and finishes a whole file.
tl::expected<void, FileError> writeWholeFile(const std::string& path, std::span<const std::byte> bytes,
                                             const OutputRules& rules = {});

/// Makes a folder, and those that it is in, if they are missing, for those who may read the files in it. True
/// if it is there then.
bool makeFolder(const std::string& path);

/// Writes the bytes of one file to another, as a whole file.
tl::expected<void, FileError> copyFile(const std::string& from, const std::string& to,
                                       const OutputRules& rules = {});

} // namespace posewire::log
