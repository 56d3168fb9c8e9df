// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/cli/program_run.h"

#include "tests/support/golden.h"

#include <QProcess>
#include <QProcessEnvironment>
#include <QTemporaryDir>

#include <fstream>
#include <regex>

namespace posewire::cli::test {

ProgramRun runProgram(const std::vector<std::string>& arguments, const std::string& input) {
    QProcess process;
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.remove("DISPLAY");
    environment.remove("WAYLAND_DISPLAY");
    process.setProcessEnvironment(environment);
    QStringList list;
    for (const std::string& argument : arguments) {
        list << QString::fromStdString(argument);
    }
    process.start(POSEWIRE_CLI, list);
    process.write(input.data(), static_cast<qint64>(input.size()));
    process.closeWriteChannel();
    if (!process.waitForFinished(60000) || process.exitStatus() != QProcess::NormalExit) {
        return {};
    }
    return {process.exitCode(), process.readAllStandardOutput().toStdString(),
            process.readAllStandardError().toStdString()};
}

QStringList endingByItself() {
#ifdef _WIN32
    return {"--duration", "10"};
#else
    return {};
#endif
}

std::string newPath() {
    static const QTemporaryDir folder;
    static int number = 0;
    return folder.filePath(QString::number(++number)).toStdString();
}

std::string fileWith(const std::string& content) {
    const std::string path = newPath();
    std::ofstream(path, std::ios::binary) << content;
    return path;
}

std::string nullDevice() {
#ifdef _WIN32
    return "NUL";
#else
    return "/dev/null";
#endif
}

bool contains(const std::string& text, const std::string& pattern) {
    return std::regex_search(text, std::regex(pattern));
}

std::string asText(const std::vector<std::byte>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string textOfFile(const std::filesystem::path& path) {
    return asText(posewire::test::readBytes(path));
}

} // namespace posewire::cli::test
