// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/interruption.h"

#include <atomic>

#include <windows.h>

namespace posewire::system {
namespace {

std::atomic<bool> hasInterruptionCome = false;
std::atomic<ULONGLONG> firstMs = 0; ///< when it came

/// Windows calls it on a thread of its own. What is not dealt with here ends the program.
BOOL WINAPI rememberInterruption(DWORD event) {
    constexpr ULONGLONG same = 500;
    constexpr DWORD longest = 10'000;
    const ULONGLONG now = ::GetTickCount64();
    const bool isFirst = !hasInterruptionCome.exchange(true);
    if (isFirst) {
        firstMs = now;
    }
    if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT) {
        ::Sleep(longest); // the console goes, and the program when this returns: let it end before
    }
    return isFirst || now - firstMs < same ? TRUE : FALSE;
}

} // namespace

Interruption::Interruption() {
    hasInterruptionCome = false;
    ::SetConsoleCtrlHandler(rememberInterruption, TRUE);
}

Interruption::~Interruption() {
    ::SetConsoleCtrlHandler(rememberInterruption, FALSE);
}

bool Interruption::hasCome() {
    return hasInterruptionCome;
}

} // namespace posewire::system
