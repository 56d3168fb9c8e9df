// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace posewire::render {

struct CloseStream {
    void operator()(std::FILE* stream) const { static_cast<void>(std::fclose(stream)); }
};

/// A regular file that is open to be read.
struct OpenedFile {
    std::unique_ptr<std::FILE, CloseStream> stream; ///< null if it could not be opened, or is too large
    std::size_t size = 0;                           ///< also of one that is too large
};

/// Opens a file by its canonical path if it is regular then and has at most kMostImportedBytes; never waits,
/// as opening a pipe would. One unit for each system: own_folder_posix.cpp, own_folder_windows.cpp.
[[nodiscard]] OpenedFile openRegular(const std::filesystem::path& canonical);

/// A character's file and what lies beside and below it: regular files, none of them by a link that leads
/// out.
class OwnFolder {
public:
    /// The path as the importer has it.
    explicit OwnFolder(const std::string& file);

    /// A path as the character's file writes it, from its folder or absolute, else the last name of the path
    /// in the folder itself.
    [[nodiscard]] OpenedFile open(const std::string& written);

    /// All that was opened but the character's file, once each, from the folder.
    [[nodiscard]] const std::vector<std::string>& filesBeside() const { return m_filesBeside; }

private:
    std::filesystem::path m_file;   ///< as it was given
    std::filesystem::path m_folder; ///< canonical; empty if there is none
    std::vector<std::string> m_filesBeside;
};

} // namespace posewire::render
