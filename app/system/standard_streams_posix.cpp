// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/standard_streams.h"

#include <csignal>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace posewire::system {

void prepareStandardStreams() {
    for (int number = 0; number < 3; ++number) {
        if (::fcntl(number, F_GETFD) < 0) {
            static_cast<void>(::open("/dev/null", O_RDWR));
        }
    }
}

void leaveFailedWritesToTheWriter() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

bool isTerminal(int descriptor) {
    return ::isatty(descriptor) == 1;
}

TerminalSize terminalSize() {
    TerminalSize size;
    winsize window{};
    if (::ioctl(kStandardOutput, TIOCGWINSZ, &window) == 0 && window.ws_row > 1 && window.ws_col > 1) {
        size = {window.ws_row, window.ws_col};
    }
    return size;
}

std::vector<std::string> argumentsOf(int count, char** arguments) {
    return {arguments, arguments + count};
}

} // namespace posewire::system
