// SPDX-License-Identifier: MIT
#include "core/log/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>

namespace posewire::log {

std::optional<FileLock> FileLock::take(const std::string& path) {
    Descriptor descriptor(::open(path.c_str(), O_RDWR | O_CLOEXEC));
    const bool isTaken = descriptor.isOpen() && ::flock(descriptor.number(), LOCK_EX | LOCK_NB) == 0;
    return isTaken ? std::optional(FileLock(std::move(descriptor))) : std::nullopt;
}

} // namespace posewire::log
