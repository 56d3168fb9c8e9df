// SPDX-License-Identifier: MIT
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace posewire::exporting {

/// Lines of cells; cells that hold a comma or a line break are looked at elsewhere.
inline std::vector<std::vector<std::string>> rowsOf(const std::string& csv) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);) {
        EXPECT_TRUE(line.ends_with('\r'));
        line.pop_back();
        auto& cells = rows.emplace_back();
        std::size_t begin = 0;
        for (std::size_t comma = 0; comma != std::string::npos; begin = comma + 1) {
            comma = line.find(',', begin);
            cells.push_back(line.substr(begin, comma == std::string::npos ? comma : comma - begin));
        }
    }
    return rows;
}

} // namespace posewire::exporting
