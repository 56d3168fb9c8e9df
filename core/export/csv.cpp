// SPDX-License-Identifier: MIT
#include "core/export/csv.h"

namespace posewire::exporting {
namespace {

void addCell(const std::string& content, std::string& line) {
    if (content.find_first_of(",\"\r\n") == std::string::npos) {
        line += content;
        return;
    }
    line += '"';
    for (const char letter : content) {
        line.append(letter == '"' ? 2 : 1, letter);
    }
    line += '"';
}

} // namespace

std::string csvLine(std::span<const std::string> cells) {
    std::string line;
    for (const std::string& cell : cells) {
        line += &cell == cells.data() ? "" : ",";
        addCell(cell, line);
    }
    return line + "\r\n";
}

} // namespace posewire::exporting
