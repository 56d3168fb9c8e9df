// SPDX-License-Identifier: MIT
#include "core/log/file_lock.h"

namespace posewire::log {

std::optional<FileLock> FileLock::take(const std::string& path) {
    Descriptor descriptor = openToLock(path);
    const bool isTaken = descriptor.isOpen() && lockForOne(descriptor);
    return isTaken ? std::optional(FileLock(std::move(descriptor))) : std::nullopt;
}

} // namespace posewire::log
