// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/ending_signals.h"

#include <QSocketNotifier>

#include <array>
#include <csignal>

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

namespace posewire::gui {
namespace {

/// A handler may do little more than write: to a pipe that the event loop looks at.
std::array<int, 2> wakeUp{-1, -1};

extern "C" void passOn(int signal) {
    const char byte = static_cast<char>(signal);
    [[maybe_unused]] const ssize_t written = ::write(wakeUp[1], &byte, 1);
}

void handle(void (*handler)(int), int flags) {
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

} // namespace

EndingSignals::EndingSignals(QObject* parent) : QObject(parent) {
    if (::pipe(wakeUp.data()) != 0) {
        return; // then they end the program as ever
    }
    for (const int end : wakeUp) {
        ::fcntl(end, F_SETFD, FD_CLOEXEC);
        ::fcntl(end, F_SETFL, O_NONBLOCK);
    }
    m_notifier = std::make_unique<QSocketNotifier>(wakeUp[0], QSocketNotifier::Read);
    connect(m_notifier.get(), &QSocketNotifier::activated, this, [this] {
        m_notifier->setEnabled(false);
        emit requested();
    });
    handle(passOn, static_cast<int>(SA_RESETHAND | SA_RESTART));
}

EndingSignals::~EndingSignals() {
    if (m_notifier) {
        handle(SIG_DFL, 0);
        m_notifier.reset();
        ::close(wakeUp[0]);
        ::close(wakeUp[1]);
    }
}

} // namespace posewire::gui
