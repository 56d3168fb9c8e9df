// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/standard_streams.h"

#include <cstdio>

#include <windows.h>

#include <fcntl.h>
#include <io.h>
#include <shellapi.h>

namespace posewire::system {
namespace {

HANDLE outputHandle() {
    return ::GetStdHandle(STD_OUTPUT_HANDLE);
}

std::string utf8Of(std::wstring_view text) {
    const int length = static_cast<int>(text.size());
    std::string result(static_cast<std::size_t>(::WideCharToMultiByte(CP_UTF8, 0, text.data(), length,
                                                                      nullptr, 0, nullptr, nullptr)),
                       '\0');
    ::WideCharToMultiByte(CP_UTF8, 0, text.data(), length, result.data(), static_cast<int>(result.size()),
                          nullptr, nullptr);
    return result;
}

} // namespace

/// A program with a window has none of its own; what it says goes to the console that it was started from.
void prepareStandardStreams() {
    const bool hasConsole = ::AttachConsole(ATTACH_PARENT_PROCESS) != FALSE; // false with one of its own, too
    for (std::FILE* stream : {stdin, stdout, stderr}) {
        if (::_fileno(stream) < 0 || ::_get_osfhandle(::_fileno(stream)) < 0) {
            const char* place = !hasConsole ? "NUL" : stream == stdin ? "CONIN$" : "CONOUT$";
            static_cast<void>(std::freopen(place, stream == stdin ? "rb" : "wb", stream));
        }
        ::_setmode(::_fileno(stream), _O_BINARY);
    }
    ::SetConsoleOutputCP(CP_UTF8);
    DWORD mode = 0;
    if (::GetConsoleMode(outputHandle(), &mode) != FALSE) {
        ::SetConsoleMode(outputHandle(),
                         mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING); // tables are written over
    }
}

void leaveFailedWritesToTheWriter() {} // there are no such signals

bool isTerminal(int descriptor) {
    return ::_isatty(descriptor) != 0;
}

TerminalSize terminalSize() {
    TerminalSize size;
    CONSOLE_SCREEN_BUFFER_INFO window{};
    if (::GetConsoleScreenBufferInfo(outputHandle(), &window) != FALSE) {
        const int rows = window.srWindow.Bottom - window.srWindow.Top + 1;
        const int columns = window.srWindow.Right - window.srWindow.Left + 1;
        if (rows > 1 && columns > 1) {
            size = {static_cast<std::size_t>(rows), static_cast<std::size_t>(columns)};
        }
    }
    return size;
}

/// Those of main() have lost every letter that the code page of this computer lacks.
std::vector<std::string> argumentsOf(int count, char** arguments) {
    int wideCount = 0;
    wchar_t** wide = ::CommandLineToArgvW(::GetCommandLineW(), &wideCount);
    if (wide == nullptr) {
        return {arguments, arguments + count};
    }
    std::vector<std::string> result;
    for (int i = 0; i < wideCount; ++i) {
        result.push_back(utf8Of(wide[i]));
    }
    ::LocalFree(wide);
    return result;
}

} // namespace posewire::system
