// SPDX-License-Identifier: MIT
#include "render/mesh/own_folder.h"

#include <algorithm>

namespace posewire::render {
namespace {

bool isWithin(const std::filesystem::path& folder, const std::filesystem::path& file) {
    const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return end == folder.end() && rest != file.end();
}

/// Follows links that stay in the folder; a file elsewhere is not even looked at. Empty for none.
std::filesystem::path followed(const std::filesystem::path& folder, std::filesystem::path file) {
    constexpr int kMostLinks = 8;
    std::error_code problem;
    for (int links = 0; links <= kMostLinks; ++links) {
        file = file.lexically_normal();
        if (!isWithin(folder, file)) {
            return {};
        }
        const std::filesystem::path rest = file.lexically_relative(folder);
        std::filesystem::path place = folder;
        auto part = rest.begin();
        while (part != rest.end() && !std::filesystem::is_symlink(place /= *part, problem)) {
            ++part;
        }
        if (part == rest.end()) {
            return file;
        }
        file = place.parent_path() / std::filesystem::read_symlink(place, problem);
        for (++part; part != rest.end(); ++part) {
            file /= *part;
        }
    }
    return {};
}

} // namespace

OwnFolder::OwnFolder(const std::string& file) : m_file(file) {
    std::error_code problem;
    m_folder = std::filesystem::canonical(m_file, problem).parent_path();
}

OpenedFile OwnFolder::open(const std::string& written) {
    std::error_code problem;
    if (m_folder.empty() || written.empty()) {
        return {};
    }
    if (m_file == written) {
        return openRegular(std::filesystem::canonical(m_file, problem));
    }
    std::string slashed = written;
    std::ranges::replace(slashed, '\\', '/');
    std::filesystem::path path(slashed);
    // Importers put the folder of the file, as they were given it, before what the file names.
    const std::filesystem::path relative = path.lexically_relative(m_file.parent_path());
    path = !m_file.has_parent_path() || relative.empty() ? path : relative;
    for (const std::filesystem::path& candidate : {m_folder / path, m_folder / path.filename()}) {
        const std::filesystem::path file = followed(m_folder, candidate);
        if (file.empty()) {
            continue;
        }
        OpenedFile opened = openRegular(file);
        const std::string name = file.lexically_relative(m_folder).string();
        if (opened.stream != nullptr && std::ranges::find(m_filesBeside, name) == m_filesBeside.end()) {
            m_filesBeside.push_back(name);
        }
        if (opened.stream != nullptr || opened.size != 0) {
            return opened;
        }
    }
    return {};
}

} // namespace posewire::render
