// SPDX-License-Identifier: MIT
#include "core/log/output_file.h"

#include "core/log/descriptor.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace posewire::log {
namespace {

using Status = struct stat;

constexpr const char* kStays = "what was written before can be read";
constexpr const char* kIsGone = "the file was not written";

tl::unexpected<FileError> unwritable(const std::string& path, int error) {
    return tl::unexpected(FileError{path + ": cannot be written (" + std::strerror(error) +
                                    "); choose another file or folder"});
}

std::optional<Status> statusOf(const std::string& path) {
    Status status{};
    return ::stat(path.c_str(), &status) == 0 ? std::optional(status) : std::nullopt;
}

std::optional<Status> statusOf(int descriptor) {
    Status status{};
    return ::fstat(descriptor, &status) == 0 ? std::optional(status) : std::nullopt;
}

/// What holds bytes that can be lost; the rest are pipes, terminals, devices.
bool holdsData(const Status& status) {
    return S_ISREG(status.st_mode) || S_ISBLK(status.st_mode);
}

/// Names of what this process has open: writing there goes on where others are.
std::optional<int> descriptorNamed(std::string_view path) {
    if (path == "/dev/stdout") {
        return STDOUT_FILENO;
    }
    if (path == "/dev/stderr") {
        return STDERR_FILENO;
    }
    for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
        int number = 0;
        const std::string_view rest = path.starts_with(folder) ? path.substr(folder.size()) : "";
        const char* end = rest.data() + rest.size();
        const auto read = std::from_chars(rest.data(), end, number);
        if (!rest.empty() && read.ec == std::errc{} && read.ptr == end && number >= 0) {
            return number;
        }
    }
    return std::nullopt;
}

tl::expected<void, FileError> checkInUse(const std::string& path, const Status& status,
                                         const OutputRules& rules) {
    for (const std::string& other : rules.inUse) {
        const auto used = other == "-" ? statusOf(STDIN_FILENO) : statusOf(other);
        if (used && holdsData(*used) && used->st_dev == status.st_dev && used->st_ino == status.st_ino) {
            const std::string which = other == path  ? ": is an input as well"
                                      : other == "-" ? ": is the same file as standard input"
                                                     : ": is the same file as " + other;
            return tl::unexpected(FileError{path + which + " and would be lost; choose another file"});
        }
    }
    return {};
}

/// Where a path leads.
struct Target {
    std::optional<int> descriptor; ///< of this process
    std::optional<Status> status;  ///< nothing where there is no file yet
};

tl::expected<Target, FileError> targetOf(const std::string& path, const OutputRules& rules) {
    Target target{descriptorNamed(path), std::nullopt};
    target.status = target.descriptor ? statusOf(*target.descriptor) : statusOf(path);
    if (!target.status) {
        Status link{};
        if (errno == ENOENT && !target.descriptor && ::lstat(path.c_str(), &link) == 0) {
            return tl::unexpected(
                FileError{path + ": is a link to a file that does not exist; name that file instead"});
        }
        const bool isNew = errno == ENOENT && !target.descriptor && !path.empty();
        return isNew ? tl::expected<Target, FileError>(target) : unwritable(path, errno);
    }
    if (S_ISDIR(target.status->st_mode)) {
        return unwritable(path, EISDIR);
    }
    if (const auto checked = checkInUse(path, *target.status, rules); !checked) {
        return tl::unexpected(checked.error());
    }
    if (!target.descriptor && holdsData(*target.status) && !rules.mayReplace) {
        return tl::unexpected(
            FileError{path + ": exists already; choose another name, or add --force to replace it"});
    }
    return target;
}

std::string folderOf(const std::string& path) {
    const auto folder = std::filesystem::path(path).parent_path();
    return folder.empty() ? "." : folder.string();
}

/// What is written in place: streams, and files that grow.
tl::expected<Descriptor, FileError> openTarget(const std::string& path, const Target& target,
                                               const OutputRules& rules) {
    constexpr int mode = 0666;
    const int flags = O_WRONLY | O_CLOEXEC | (target.status ? 0 : O_CREAT | O_EXCL);
    Descriptor descriptor(target.descriptor ? ::dup(*target.descriptor) : ::open(path.c_str(), flags, mode));
    if (!descriptor.isOpen()) {
        return unwritable(path, errno);
    }
    const auto status = statusOf(descriptor.number()); // another file may be there by now
    if (!target.descriptor && status && S_ISREG(status->st_mode)) {
        if (const auto checked = checkInUse(path, *status, rules); !checked) {
            return tl::unexpected(checked.error());
        }
        if (::ftruncate(descriptor.number(), 0) != 0) {
            return unwritable(path, errno);
        }
    }
    return descriptor;
}

/// A new file in the folder of `path`; `name` gets what it is called until it is complete.
Descriptor openBeside(const std::string& path, std::string& name) {
    constexpr int attempts = 1000;
    for (int number = 0; number < attempts; ++number) {
        name = folderOf(path) + "/.posewire-" + std::to_string(::getpid()) + '-' + std::to_string(number) +
               ".part";
        Descriptor descriptor(::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
        if (descriptor.isOpen() || errno != EEXIST) {
            return descriptor;
        }
    }
    return Descriptor();
}

/// Gives a file its name; fails with EEXIST where that is taken and may not be.
bool giveName(const std::string& from, const std::string& to, bool mayReplace) {
    if (!mayReplace) {
        if (::link(from.c_str(), to.c_str()) == 0) {
            ::unlink(from.c_str());
            return true;
        }
        const bool isTaken = errno == EEXIST || ::access(to.c_str(), F_OK) == 0;
        if (isTaken) {
            errno = EEXIST;
            return false;
        }
    }
    std::error_code error;
    std::filesystem::rename(from, to, error); // some disks know no links
    errno = error.value();
    return !error;
}

class WholeFileSink final : public DescriptorSink {
public:
    WholeFileSink(Descriptor descriptor, std::string path, std::string target, std::string temporary,
                  bool mayReplace)
        : DescriptorSink(std::move(descriptor), std::move(path), kIsGone),
          m_target(std::move(target)),
          m_temporary(std::move(temporary)),
          m_mayReplace(mayReplace) {}
    ~WholeFileSink() override {
        if (!m_temporary.empty()) {
            discard();
            ::unlink(m_temporary.c_str());
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
        const Descriptor folder(::open(folderOf(m_target).c_str(), O_RDONLY | O_CLOEXEC));
        if (folder.isOpen()) {
            ::fsync(folder.number());
        }
        return {};
    }

private:
    std::string m_target;
    std::string m_temporary; ///< empty once it has got its name
    bool m_mayReplace;
};

} // namespace

tl::expected<void, FileError> checkOutput(const std::string& path, const OutputRules& rules) {
    const auto target = targetOf(path, rules);
    if (!target) {
        return tl::unexpected(target.error());
    }
    if (!target->status && ::access(folderOf(path).c_str(), W_OK | X_OK) != 0) {
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
    return openTarget(path, *target, rules).map([&](Descriptor&& descriptor) -> std::unique_ptr<ByteSink> {
        return std::make_unique<DescriptorSink>(std::move(descriptor), path, kStays);
    });
}

tl::expected<std::unique_ptr<ByteSink>, FileError> createWholeFile(const std::string& path,
                                                                   const OutputRules& rules) {
    const auto target = targetOf(path, rules);
    if (!target) {
        return tl::unexpected(target.error());
    }
    const bool isFile = !target->descriptor && (!target->status || S_ISREG(target->status->st_mode));
    if (!isFile) {
        return createFile(path, rules);
    }
    std::error_code ignored;
    const std::string real = target->status ? std::filesystem::canonical(path, ignored).string() : path;
    std::string temporary;
    Descriptor descriptor = openBeside(real, temporary);
    if (!descriptor.isOpen()) {
        return unwritable(path, errno);
    }
    if (target->status) {
        // Who could read it can read it again; where that may not be told, it stays ours.
        static_cast<void>(::fchmod(descriptor.number(), target->status->st_mode & 07777U));
        [[maybe_unused]] const int given =
            ::fchown(descriptor.number(), target->status->st_uid, target->status->st_gid);
    }
    return std::make_unique<WholeFileSink>(std::move(descriptor), path, real, temporary, rules.mayReplace);
}

tl::expected<void, FileError> writeWholeFile(const std::string& path, std::span<const std::byte> bytes,
                                             const OutputRules& rules) {
    auto sink = createWholeFile(path, rules);
    if (!sink) {
        return tl::unexpected(sink.error());
    }
    if (auto written = (*sink)->write(bytes); !written) {
        return written;
    }
    return (*sink)->finish();
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
