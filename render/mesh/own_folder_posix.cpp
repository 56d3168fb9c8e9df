// SPDX-License-Identifier: MIT
#include "render/mesh/character_file.h"
#include "render/mesh/own_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace posewire::render {

OpenedFile openRegular(const std::filesystem::path& canonical) {
    const int descriptor = ::open(canonical.c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
    struct stat status {};
    if (descriptor < 0) {
        return {};
    }
    OpenedFile file;
    if (::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode)) {
        file.size = static_cast<std::size_t>(status.st_size);
        if (file.size <= kMostImportedBytes) {
            file.stream.reset(::fdopen(descriptor, "rb"));
        }
    }
    if (file.stream == nullptr) {
        ::close(descriptor);
    }
    return file;
}

} // namespace posewire::render
