// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/command.h"
#include "app/gui/base/options.h"
#include "packaging/manual/pages.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

namespace {

using namespace posewire;

/// Where each program's files go, and what they are made from.
struct Places {
    std::filesystem::path frames;
    std::filesystem::path output;
    manual::PageFacts facts;
};

bool write(const std::filesystem::path& path, const std::string& text) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (file.fail()) {
        std::cerr << "cannot write " << path.string() << '\n';
        return false;
    }
    return true;
}

bool writePage(const usage::Program& program, const Places& places) {
    const std::filesystem::path path = places.frames / (program.name + ".1.in");
    std::ifstream file(path, std::ios::binary);
    const std::string frame{std::istreambuf_iterator<char>(file), {}};
    const auto page = manual::manualPage(program, frame, places.facts);
    if (!page) {
        std::cerr << path.string() << ": " << page.error() << '\n';
        return false;
    }
    return write(places.output / (program.name + ".1.in"), *page);
}

} // namespace

/// manual_generator FRAMES OUTPUT VERSION DATE: writes the manual pages and completions of both programs.
int main(int argc, char** argv) {
    if (argc != 5) {
        std::cerr << "usage: manual_generator FRAMES OUTPUT VERSION DATE\n";
        return 2;
    }
    const Places places{argv[1], argv[2], {argv[3], argv[4]}};
    bool isWritten = true;
    for (const usage::Program& program : std::array{gui::programUsage(), cli::Program().line.usage()}) {
        isWritten = isWritten && writePage(program, places) &&
                    write(places.output / "bash" / program.name, manual::bashCompletion(program));
    }
    return isWritten ? 0 : 1;
}
