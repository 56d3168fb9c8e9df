// SPDX-License-Identifier: MIT
#include "core/log/output_file.h"

#include "core/log/descriptor_sink.h"
#include "core/log/file_names.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>
#include <thread>
#include <vector>

namespace posewire::log {
namespace {

using Kind = FileStatus::Kind;

constexpr int kInputDescriptor = 0;
constexpr const char* kStays = "what was written before can be read";
constexpr const char* kIsGone = "the file was not written";

tl::unexpected<FileError> unwritable(const std::string& path, int error) {
    if (const auto status = error == ENXIO ? statusOf(path) : std::nullopt; status && status->isPipe) {
        return tl::unexpected(FileError{path + ": is a pipe that nobody reads; start its reader first",
                                        FileError::Kind::Unread});
    }
    return tl::unexpected(FileError{path + ": cannot be written (" + std::strerror(error) +
                                    "); choose another file or folder"});
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

/// Where a path leads.
struct Target {
    std::optional<int> descriptor;    ///< of this process
    std::optional<FileStatus> status; ///< nothing where there is no file yet
};

tl::expected<Target, FileError> targetOf(const std::string& path, const OutputRules& rules) {
    Target target{descriptorNamed(path), std::nullopt};
    target.status = target.descriptor ? statusOf(*target.descriptor) : statusOf(path);
    if (!target.status) {
        const int error = errno;
        const bool isMissing = error == ENOENT && !target.descriptor;
        if (isMissing && isLink(path)) {
            return tl::unexpected(
                FileError{path + ": is a link to a file that does not exist; name that file instead"});
        }
        return isMissing && !path.empty() ? tl::expected<Target, FileError>(target) : unwritable(path, error);
    }
    if (target.status->kind == Kind::Folder) {
        return unwritable(path, EISDIR);
    }
    if (const auto checked = checkInUse(path, *target.status, rules); !checked) {
        return tl::unexpected(checked.error());
    }
    if (!target.descriptor && target.status->holdsData() && !rules.mayReplace) {
        return tl::unexpected(
            FileError{path + ": exists already; choose another name, or add --force to replace it"});
    }
    return target;
}

std::string folderOf(const std::string& path) {
    const std::string folder = nameOf(pathOf(path).parent_path());
    return folder.empty() ? "." : folder;
}

Descriptor openExisting(const std::string& path, const FileStatus& status, const OutputRules& rules) {
    constexpr std::chrono::milliseconds step{20};
    while (true) {
        Descriptor descriptor = openToWrite(path);
        const bool isUnread = !descriptor.isOpen() && errno == ENXIO && status.isPipe;
        if (!isUnread) {
            return descriptor;
        }
        if (!rules.waitsForReader || !rules.waitsForReader()) {
            errno = ENXIO;
            return descriptor;
        }
        std::this_thread::sleep_for(step);
    }
}

/// What is written in place: streams, and files that grow.
tl::expected<Descriptor, FileError> openTarget(const std::string& path, const Target& target,
                                               const OutputRules& rules) {
    Descriptor descriptor = target.descriptor ? duplicateOf(*target.descriptor)
                            : target.status   ? openExisting(path, *target.status, rules)
                                              : createToWrite(path);
    if (!descriptor.isOpen()) {
        return unwritable(path, errno);
    }
    const auto status = statusOf(descriptor.number()); // another file may be there by now
    if (!target.descriptor && status && status->kind == Kind::File) {
        if (const auto checked = checkInUse(path, *status, rules); !checked) {
            return tl::unexpected(checked.error());
        }
        if (!makeEmpty(descriptor)) {
            return unwritable(path, errno);
        }
    }
    return descriptor;
}

/// A new file in the folder of `path`; `name` gets what it is called until it is complete.
Descriptor openBeside(const std::string& path, std::string& name) {
    constexpr int attempts = 1000;
    for (int number = 0; number < attempts; ++number) {
        name = folderOf(path) + "/.posewire-" + std::to_string(processNumber()) + '-' +
               std::to_string(number) + ".part";
        Descriptor descriptor = createToWrite(name);
        if (descriptor.isOpen() || errno != EEXIST) {
            return descriptor;
        }
    }
    return Descriptor();
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
            removeFile(m_temporary);
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
    std::string m_temporary; ///< empty once it has got its name
    bool m_mayReplace;
};

} // namespace

tl::expected<void, FileError> checkOutput(const std::string& path, const OutputRules& rules) {
    const auto target = targetOf(path, rules);
    if (!target) {
        return tl::unexpected(target.error());
    }
    if (!target->status && !mayCreateIn(folderOf(path))) {
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
    const bool isFile = !target->descriptor && (!target->status || target->status->kind == Kind::File);
    if (!isFile) {
        return createFile(path, rules);
    }
    std::error_code ignored;
    const std::string real =
        target->status ? nameOf(std::filesystem::canonical(pathOf(path), ignored)) : path;
    std::string temporary;
    Descriptor descriptor = openBeside(real, temporary);
    if (!descriptor.isOpen()) {
        return unwritable(path, errno);
    }
    if (target->status) {
        takeRights(descriptor, *target->status);
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
