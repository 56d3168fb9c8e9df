// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/interruption.h"

#include <csignal>

namespace posewire::cli {
namespace {

volatile std::sig_atomic_t hasInterruptionCome = 0;

extern "C" void rememberInterruption(int signal) {
    hasInterruptionCome = 1;
    std::signal(signal, SIG_DFL);
}

} // namespace

Interruption::Interruption() {
    hasInterruptionCome = 0;
    std::signal(SIGINT, rememberInterruption);
    std::signal(SIGTERM, rememberInterruption);
}

Interruption::~Interruption() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

bool Interruption::hasCome() const {
    return hasInterruptionCome != 0;
}

} // namespace posewire::cli
