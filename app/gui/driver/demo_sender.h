// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>

namespace posewire::gui {

/// The performer as a sender beside the window: its datagrams go through a real socket to a port of this
/// computer, from a thread of its own, until the object ends.
class DemoSender {
public:
    DemoSender(int characters, std::uint16_t port);
    ~DemoSender();
    DemoSender(const DemoSender&) = delete;
    DemoSender& operator=(const DemoSender&) = delete;

private:
    void run(int characters, std::uint16_t port);

    std::atomic<bool> m_isStopping = false;
    std::thread m_thread; // last: it uses the others
};

} // namespace posewire::gui
