// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/interruption.h"

#include <atomic>
#include <csignal>
#include <cstdint>

#include <signal.h>
#include <time.h>

namespace posewire::system {
namespace {

std::atomic<bool> hasInterruptionCome = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler writes it");

std::atomic<std::int64_t> firstMs = 0; ///< when it came

std::int64_t nowMs() {
    timespec now{};
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return std::int64_t{now.tv_sec} * 1000 + now.tv_nsec / 1'000'000;
}

/// A SIGHUP that the program was started to ignore stays so (nohup).
void handleEndings(void (*handler)(int)) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction action {};
        const bool isIgnored = ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
        if (signal == SIGHUP && isIgnored) {
            continue;
        }
        action = {};
        action.sa_handler = handler;
        ::sigaction(signal, &action, nullptr);
    }
}

/// What comes at once is the same again: timeout(1) signals a program and then its group.
extern "C" void rememberInterruption(int signal) {
    constexpr std::int64_t same = 500;
    const std::int64_t now = nowMs();
    if (!hasInterruptionCome) {
        firstMs = now;
        hasInterruptionCome = true;
    } else if (now - firstMs >= same) {
        std::signal(signal, SIG_DFL);
        ::raise(signal);
    }
}

} // namespace

Interruption::Interruption() {
    hasInterruptionCome = false;
    handleEndings(rememberInterruption);
}

Interruption::~Interruption() {
    handleEndings(SIG_DFL);
}

bool Interruption::hasCome() {
    return hasInterruptionCome;
}

} // namespace posewire::system
