// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/ending_request.h"

#include "app/system/ending_signals_posix.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <utility>

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

namespace posewire::system {
namespace {

/// A handler may do little more than write: to a pipe that a thread reads.
std::array<int, 2> wakeUp{-1, -1};

extern "C" void passOn(int signal) {
    const int error = errno;
    handleEndings(SIG_DFL, 0); // the next one ends the program, whichever it is
    const char byte = static_cast<char>(signal);
    [[maybe_unused]] const ssize_t written = ::write(wakeUp[1], &byte, 1);
    errno = error;
}

} // namespace

EndingRequest::EndingRequest(std::function<void()> onRequest) : m_onRequest(std::move(onRequest)) {
    if (::pipe(wakeUp.data()) != 0) {
        return; // then they end the program as ever
    }
    for (const int end : wakeUp) {
        ::fcntl(end, F_SETFD, FD_CLOEXEC);
    }
    ::fcntl(wakeUp[1], F_SETFL, O_NONBLOCK);
    m_thread = std::thread([this] {
        char byte = 0;
        ssize_t count = 0;
        do {
            count = ::read(wakeUp[0], &byte, 1);
        } while (count < 0 && errno == EINTR);
        if (count == 1) { // 0 at the end
            m_onRequest();
        }
    });
    handleEndings(passOn, SA_RESTART);
}

EndingRequest::~EndingRequest() {
    if (m_thread.joinable()) {
        handleEndings(SIG_DFL, 0);
        ::close(wakeUp[1]);
        m_thread.join();
        ::close(wakeUp[0]);
    }
}

} // namespace posewire::system
