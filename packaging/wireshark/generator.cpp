// SPDX-License-Identifier: GPL-3.0-or-later
#include "packaging/wireshark/dissector_tables.h"

#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

namespace {

bool replaceLine(std::string& text, std::string_view line, std::string_view with) {
    const std::size_t place = text.find(line);
    if (place == std::string::npos) {
        return false;
    }
    text.replace(place, line.size(), with);
    return true;
}

} // namespace

/// dissector_generator TEMPLATE OUTPUT: writes mxtp.lua.
int main(int argc, char** argv) {
    if (argc != 3) {
        std::cerr << "usage: dissector_generator TEMPLATE OUTPUT\n";
        return 2;
    }
    std::ifstream file(argv[1], std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    const bool isComplete =
        replaceLine(
            text, "--@origin@\n",
            "-- Made by the build from the tables of core/wire and from mxtp.template.lua; edit those.\n") &&
        replaceLine(text, "--@tables@\n", posewire::wireshark::dissectorTables());
    if (!isComplete) {
        std::cerr << argv[1] << ": has no lines @origin@ and @tables@\n";
        return 1;
    }
    std::ofstream output(argv[2], std::ios::binary);
    output << text;
    output.close();
    if (output.fail()) {
        std::cerr << "cannot write " << argv[2] << '\n';
        return 1;
    }
    return 0;
}
