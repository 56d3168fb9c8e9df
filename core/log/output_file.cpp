// SPDX-License-Identifier: MIT
#include "core/log/output_file.h"

#include "core/log/file_names.h"
#include "core/log/system_files.h"

#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>

namespace posewire::log {
namespace {

using Kind = FileStatus::Kind;

std::atomic<unsigned> newFileMode = 0600;

constexpr int kInputDescriptor = 0;
constexpr int kOutputDescriptor = 1;
constexpr const char* kStays = "what was written before can be read";
constexpr const char* kIsGone = "the file was not written";

tl::unexpected<FileError> unwritable(const std::string& path, int error) {
    if (error == ENXIO) {
        return tl::unexpected(FileError{path + ": is a pipe without a reader; start its reader first"});
    }
    return tl::unexpected(FileError{path + ": cannot be written (" + std::strerror(error) +
                                    "); choose another file or folder"});
}

tl::unexpected<FileError> beingWritten(const std::string& path) {
    return tl::unexpected(FileError{path + ": is being recorded to at present; choose another name"});
}

tl::expected<void, FileError> checkInUse(const std::string& path, const FileStatus& status,
                                         const OutputRules& rules) {
    for (const std::string& other : rules.inUse) {
        const auto used = other == "-" ? statusOf(kInputDescriptor) : statusOf(other);
        if (used && used->holdsData() && used->isSameFileAs(status)) {
            const std::string which = other == path  ? ": is an input as well"
                                      : other == "-" ? ": is the same file as standard input"
                                                     : ": is the same file as " + other;
            return tl::unexpected(FileError{path + which + " and would be lost; choose another file"});
        }
    }
    return {};
}

/// The file that is there already, if there is one.
using Target = std::optional<FileStatus>;

tl::expected<Target, FileError> targetOf(const std::string& path, const OutputRules& rules) {
    const bool isStandard = path == kStandardOutput;
    const Target target = isStandard ? statusOf(kOutputDescriptor) : statusOf(path);
    if (!target) {
        const int error = errno;
        const bool isMissing = error == ENOENT && !isStandard && !path.empty();
        std::error_code ignored;
        if (isMissing && std::filesystem::is_symlink(pathOf(path), ignored)) {
            return tl::unexpected(
                FileError{path + ": is a link to a file that does not exist; name that file instead"});
        }
        return isMissing ? tl::expected<Target, FileError>(target) : unwritable(path, error);
    }
    if (target->kind == Kind::Folder) {
        return unwritable(path, EISDIR);
    }
    if (const auto checked = checkInUse(path, *target, rules); !checked) {
        return tl::unexpected(checked.error());
    }
    if (!isStandard && target->holdsData() && !rules.mayReplace) {
        return tl::unexpected(
            FileError{path + ": exists already; choose another name, or add --force to replace it"});
    }
    if (!isStandard && target->kind == Kind::File && !openLocked(path).isOpen() && errno == EWOULDBLOCK) {
        return beingWritten(path);
    }
    return target;
}

std::string folderOf(const std::string& path) {
    const std::string folder = nameOf(pathOf(path).parent_path());
    return folder.empty() ? "." : folder;
}

/// Opens a stream or a file that grows.
tl::expected<Descriptor, FileError> openTarget(const std::string& path, bool exists,
                                               const OutputRules& rules) {
    if (path == kStandardOutput) {
        return duplicateOf(kOutputDescriptor);
    }
    Descriptor descriptor = exists ? openToWrite(path) : createToWrite(path, newFileMode);
    if (!descriptor.isOpen()) {
        return unwritable(path, errno);
    }
    const auto status = statusOf(descriptor.number()); // another file may be there by now
    if (status && status->kind == Kind::File) {
        if (const auto checked = checkInUse(path, *status, rules); !checked) {
            return tl::unexpected(checked.error());
        }
        if (rules.isWatched && !lockFile(descriptor) && errno == EWOULDBLOCK) {
            return beingWritten(path);
        }
        if (!makeEmpty(descriptor)) {
            return unwritable(path, errno);
        }
    }
    return descriptor;
}

/// A new file in the folder of `path`; `name` becomes its name until it is complete.
Descriptor openBeside(const std::string& path, std::string& name) {
    constexpr int attempts = 1000;
    for (int number = 0; number < attempts; ++number) {
        name = folderOf(path) + "/.posewire-" + std::to_string(processNumber()) + '-' +
               std::to_string(number) + ".part";
        Descriptor descriptor = createToWrite(name, newFileMode);
        if (descriptor.isOpen() || errno != EEXIST) {
            return descriptor;
        }
    }
    return Descriptor();
}

/// Buffers small pieces.
class FileSink : public ByteSink {
public:
    /// `consequence` ends the messages about failures. `isInPlace`: flush() looks whether it still is.
    FileSink(Descriptor descriptor, std::string name, const char* consequence, bool isInPlace)
        : m_descriptor(std::move(descriptor)),
          m_name(std::move(name)),
          m_consequence(consequence),
          m_isInPlace(isInPlace) {
        m_waiting.reserve(kBuffer);
    }
    /// Writes the rest; call flush() before to learn of a failure.
    ~FileSink() override { static_cast<void>(putWaiting()); }

    tl::expected<void, FileError> write(std::span<const std::byte> bytes) override {
        if (m_waiting.size() + bytes.size() > kBuffer) {
            if (auto flushed = putWaiting(); !flushed) {
                return flushed;
            }
        }
        if (bytes.size() >= kBuffer) {
            return put(bytes);
        }
        m_waiting.insert(m_waiting.end(), bytes.begin(), bytes.end());
        return {};
    }
    tl::expected<void, FileError> flush() override {
        return putWaiting().and_then([this] { return checkPlace(); });
    }
    tl::expected<void, FileError> sync() override {
        if (auto flushed = flush(); !flushed) {
            return flushed;
        }
        return bringToDisk(m_descriptor) ? tl::expected<void, FileError>() : failure();
    }

protected:
    [[nodiscard]] const std::string& name() const { return m_name; }
    /// Drops the buffer and everything that comes after it.
    void discard() {
        m_waiting.clear();
        m_hasFailed = true;
    }

private:
    static constexpr std::size_t kBuffer = std::size_t{64} << 10;
    /// Between two looks at a full pipe.
    static constexpr std::chrono::milliseconds kPause{100};

    tl::expected<void, FileError> putWaiting() {
        auto result = put(m_waiting);
        m_waiting.clear();
        return result;
    }
    /// Fails if the name of the file no longer leads to it, or another program has cut it.
    [[nodiscard]] tl::expected<void, FileError> checkPlace() const {
        const auto own = m_isInPlace ? statusOf(m_descriptor.number()) : std::nullopt;
        if (!own || own->kind != Kind::File) {
            return {};
        }
        const auto there = statusOf(m_name);
        const char* const what = there && !there->isSameFileAs(*own) ? "another file has taken its place"
                                 : own->names == 0       ? "it was removed while it was being written"
                                 : !there                ? "it was moved while it was being written"
                                 : own->size < m_written ? "another program has cut it"
                                                         : nullptr;
        return what == nullptr ? tl::expected<void, FileError>()
                               : tl::unexpected(FileError{m_name + ": " + what, FileError::Kind::Displaced});
    }
    tl::expected<void, FileError> put(std::span<const std::byte> bytes) {
        while (!bytes.empty() && !m_hasFailed) {
            const std::ptrdiff_t count = writeSome(m_descriptor.number(), bytes);
            if (count >= 0) {
                m_written += static_cast<std::uint64_t>(count);
                bytes = bytes.subspan(static_cast<std::size_t>(count));
            } else if (errno == EAGAIN) {
                static_cast<void>(hasRoom(m_descriptor.number(), kPause));
            } else if (errno != EINTR) {
                return failure();
            }
        }
        return {};
    }

    [[nodiscard]] tl::unexpected<FileError> failure() {
        const int error = errno;
        m_hasFailed = true;
        std::string why;
        switch (error) {
        case ENOSPC:
#ifdef EDQUOT
        case EDQUOT:
#endif
            why = "the disk is full; make room or choose another disk";
            break;
        case EFBIG:
            why = "writing failed (the file has the largest size that is allowed); raise the limit, see "
                  "ulimit -f";
            break;
        case EPIPE:
            why = "its reader is gone";
            break;
        default:
            why = std::string("writing failed (") + std::strerror(error) + "); is the disk still there?";
        }
        return tl::unexpected(FileError{m_name + ": " + why + "; " + m_consequence,
                                        error == EPIPE ? FileError::Kind::Unread : FileError::Kind::Failed});
    }

    Descriptor m_descriptor;
    std::string m_name;
    const char* m_consequence;
    std::vector<std::byte> m_waiting;
    std::uint64_t m_written = 0;
    bool m_isInPlace;
    bool m_hasFailed = false;
};

class WholeFileSink final : public FileSink {
public:
    WholeFileSink(Descriptor descriptor, std::string path, std::string target, std::string temporary,
                  bool mayReplace)
        : FileSink(std::move(descriptor), std::move(path), kIsGone, false),
          m_target(std::move(target)),
          m_temporary(std::move(temporary)),
          m_mayReplace(mayReplace) {}
    ~WholeFileSink() override {
        if (!m_temporary.empty()) {
            discard();
            std::error_code ignored;
            std::filesystem::remove(pathOf(m_temporary), ignored);
        }
    }

    tl::expected<void, FileError> finish() override {
        if (auto synced = sync(); !synced) {
            return synced;
        }
        if (!giveName(m_temporary, m_target, m_mayReplace)) {
            return errno == EEXIST ? tl::unexpected(FileError{name() + ": exists by now; " + kIsGone})
                                   : unwritable(name(), errno);
        }
        m_temporary.clear();
        bringNameToDisk(m_target);
        return {};
    }

private:
    std::string m_target;
    std::string m_temporary; ///< empty once it has its final name
    bool m_mayReplace;
};

} // namespace

std::string setFileMode(const std::string& octal) {
    constexpr unsigned kOwner = 0600;
    constexpr unsigned kAll = 0666;
    unsigned mode = 0;
    const char* const end = octal.data() + octal.size();
    const auto read = std::from_chars(octal.data(), end, mode, 8);
    if (read.ec != std::errc() || read.ptr != end || (mode & kOwner) != kOwner || (mode & ~kAll) != 0) {
        return "--mode: '" + octal + "' is none such as 0600, 0640 or 0664";
    }
    newFileMode = mode;
    return {};
}

tl::expected<void, FileError> checkOutput(const std::string& path, const OutputRules& rules) {
    const auto target = targetOf(path, rules);
    if (!target) {
        return tl::unexpected(target.error());
    }
    if (!target->has_value() && !mayCreateIn(folderOf(path))) {
        return unwritable(path, errno);
    }
    return {};
}

tl::expected<std::unique_ptr<ByteSink>, FileError> createFile(const std::string& path,
                                                              const OutputRules& rules) {
    const auto target = targetOf(path, rules);
    if (!target) {
        return tl::unexpected(target.error());
    }
    const bool exists = target->has_value();
    return openTarget(path, exists, rules).map([&](Descriptor&& descriptor) -> std::unique_ptr<ByteSink> {
        bringNameToDisk(path);
        const bool isInPlace = rules.isWatched && path != kStandardOutput;
        return std::make_unique<FileSink>(std::move(descriptor), path, kStays, isInPlace);
    });
}

tl::expected<std::unique_ptr<ByteSink>, FileError> createWholeFile(const std::string& path,
                                                                   const OutputRules& rules) {
    const auto target = targetOf(path, rules);
    if (!target) {
        return tl::unexpected(target.error());
    }
    const bool exists = target->has_value();
    if (path == kStandardOutput || (exists && (*target)->kind != Kind::File)) {
        return createFile(path, rules);
    }
    std::error_code ignored;
    const std::string real = exists ? nameOf(std::filesystem::canonical(pathOf(path), ignored)) : path;
    std::string temporary;
    Descriptor descriptor = openBeside(real, temporary);
    if (!descriptor.isOpen()) {
        return unwritable(path, errno);
    }
    if (exists) { // best effort: a private file stays private
        const auto permissions = std::filesystem::status(pathOf(real), ignored).permissions();
        std::filesystem::permissions(pathOf(temporary), permissions, ignored);
    }
    return std::make_unique<WholeFileSink>(std::move(descriptor), path, real, temporary, rules.mayReplace);
}

tl::expected<void, FileError> writeWholeFile(const std::string& path, std::span<const std::byte> bytes,
                                             const OutputRules& rules) {
    return createWholeFile(path, rules).and_then([&](const std::unique_ptr<ByteSink>& sink) {
        return sink->write(bytes).and_then([&] { return sink->finish(); });
    });
}

bool makeFolder(const std::string& path) {
    namespace fs = std::filesystem;
    constexpr unsigned kReading = 0444; // who may read a folder may enter it
    std::error_code failed;
    const fs::path folder = pathOf(path);
    const std::string parent = nameOf(folder.parent_path());
    if (!fs::exists(folder, failed) && (parent.empty() || parent == path || makeFolder(parent)) &&
        fs::create_directory(folder, failed)) {
        const unsigned mode = newFileMode;
        fs::permissions(folder, fs::perms(mode | (mode & kReading) >> 2U), failed);
    }
    return fs::is_directory(folder, failed);
}

tl::expected<void, FileError> copyFile(const std::string& from, const std::string& to,
                                       const OutputRules& rules) {
    constexpr std::size_t kPiece = std::size_t{1} << 20;
    const auto source = openFile(from);
    if (!source) {
        return tl::unexpected(source.error());
    }
    const auto sink = createWholeFile(to, rules);
    if (!sink) {
        return tl::unexpected(sink.error());
    }
    std::vector<std::byte> piece(kPiece);
    while (true) {
        const auto read = (*source)->read(piece);
        if (!read) {
            return tl::unexpected(read.error());
        }
        if (*read == 0) {
            return (*sink)->finish();
        }
        if (auto written = (*sink)->write(std::span(piece).first(*read)); !written) {
            return written;
        }
    }
}

} // namespace posewire::log
