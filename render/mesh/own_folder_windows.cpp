// SPDX-License-Identifier: MIT
#include "render/mesh/character_file.h"
#include "render/mesh/own_folder.h"

#include <system_error>

namespace posewire::render {

OpenedFile openRegular(const std::filesystem::path& canonical) {
    std::error_code problem;
    if (!std::filesystem::is_regular_file(canonical, problem)) {
        return {};
    }
    OpenedFile file;
    file.size = static_cast<std::size_t>(std::filesystem::file_size(canonical, problem));
    if (!problem && file.size <= kMostImportedBytes) {
        file.stream.reset(::_wfopen(canonical.c_str(), L"rb"));
    }
    return file;
}

} // namespace posewire::render
