// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/system_files.h"

#include <optional>
#include <string>
#include <utility>

namespace posewire::log {

/// A file that this owner uses and no other, as long as it lives: it ends with the process, however that
/// ends. Only who locks too is kept out.
class FileLock {
public:
    /// Nothing where another owner has it, in this process or in any, or the file cannot be opened.
    [[nodiscard]] static std::optional<FileLock> take(const std::string& path);

private:
    explicit FileLock(Descriptor descriptor) : m_descriptor(std::move(descriptor)) {}

    Descriptor m_descriptor;
};

} // namespace posewire::log
