// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/ending_request.h"

#include <mutex>
#include <utility>

#include <windows.h>

namespace posewire::system {
namespace {

std::mutex inUse;
std::function<void()> toCall; ///< once; guarded by the mutex

/// Windows calls it on a thread of its own. What is not dealt with here ends the program.
BOOL WINAPI passOn(DWORD event) {
    constexpr DWORD longest = 10'000;
    bool isFirst = false;
    {
        const std::lock_guard lock(inUse);
        if (const auto function = std::exchange(toCall, {})) {
            function();
            isFirst = true;
        }
    }
    if (isFirst && event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT) {
        ::Sleep(longest); // the program goes when this returns: let it end before
    }
    return isFirst ? TRUE : FALSE;
}

} // namespace

EndingRequest::EndingRequest(std::function<void()> onRequest) : m_onRequest(std::move(onRequest)) {
    const std::lock_guard lock(inUse);
    toCall = m_onRequest;
    ::SetConsoleCtrlHandler(passOn, TRUE);
}

EndingRequest::~EndingRequest() {
    ::SetConsoleCtrlHandler(passOn, FALSE);
    const std::lock_guard lock(inUse);
    toCall = {};
}

} // namespace posewire::system
