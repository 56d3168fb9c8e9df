// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <thread>

namespace posewire::system {

/// While one lives, the first Ctrl+C (SIGINT), SIGTERM or SIGHUP calls a function on another thread; a second
/// one ends the program at once. A SIGHUP that is ignored stays so (nohup). On Windows it is Ctrl+C,
/// Ctrl+Break and the end of the console, where there is one. One object at a time.
class EndingRequest {
public:
    explicit EndingRequest(std::function<void()> onRequest);
    /// The function is not called any more.
    ~EndingRequest();
    EndingRequest(const EndingRequest&) = delete;
    EndingRequest& operator=(const EndingRequest&) = delete;

private:
    std::function<void()> m_onRequest;
    std::thread m_thread; ///< where the system has none for it
};

} // namespace posewire::system
