// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/ending_signals_posix.h"

#include <csignal>

#include <signal.h>

namespace posewire::system {

void handleEndings(void (*handler)(int), int flags) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction action {};
        const bool isIgnored = ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
        if (signal == SIGHUP && isIgnored) {
            continue;
        }
        action = {};
        action.sa_handler = handler;
        action.sa_flags = flags;
        ::sigaction(signal, &action, nullptr);
    }
}

} // namespace posewire::system
