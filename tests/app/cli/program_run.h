// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QStringList>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace posewire::cli::test {

/// What came of running posewire-cli.
struct ProgramRun {
    int status = -1;
    std::string out;
    std::string err;
};

/// Runs the built program with these arguments and standard input, without a display.
[[nodiscard]] ProgramRun runProgram(const std::vector<std::string>& arguments, const std::string& input = {});

/// Arguments that end `monitor` where no test can press Ctrl+C; else none.
[[nodiscard]] QStringList endingByItself();

/// A file with that content that is gone after the test program; its path.
[[nodiscard]] std::string fileWith(const std::string& content);

/// A path where no file is yet; in a folder that is gone after the test program.
[[nodiscard]] std::string newPath();

/// What takes all that is written to it.
[[nodiscard]] std::string nullDevice();

/// Regular expression as in ECMAScript; that of GoogleTest knows no sets on Windows.
[[nodiscard]] bool contains(const std::string& text, const std::string& pattern);
[[nodiscard]] std::string asText(const std::vector<std::byte>& bytes);
[[nodiscard]] std::string textOfFile(const std::filesystem::path& path);

} // namespace posewire::cli::test
