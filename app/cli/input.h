// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/byte_io.h"

#include <iostream>

namespace posewire::cli {

/// The file of that name; standard input for "-".
inline tl::expected<std::unique_ptr<log::ByteSource>, log::FileError> openInput(const std::string& path) {
    if (path == "-") {
        return log::readingFrom(std::cin, "standard input");
    }
    return log::openFile(path);
}

} // namespace posewire::cli
