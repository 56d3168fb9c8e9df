// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/allow_list.h"
#include "app/net/command_queue.h"
#include "app/net/group_memberships.h"
#include "app/net/input.h"
#include "app/net/packet_queue.h"
#include "app/net/receiver.h"
#include "core/log/clock.h"
#include "core/log/packet_log.h"

#include <atomic>
#include <memory>
#include <set>

namespace posewire::net {

/// Must outlive the loop.
struct ReceiveContext {
    log::PacketLog& log;
    const log::Clock& clock;
    PacketQueue& queue;
    CommandQueue& commands;
    ReceiveCounters& counters;
    const std::atomic<log::Duration>& nap; ///< the longest one, as set last
    ReceiverOptions options;
};

/// An address of this computer may go, but not that of the loopback; all others are those of groups, nets or
/// all interfaces.
inline void listenOnOwn(GroupMemberships& groups, const Input& input) {
    const QHostAddress address(QString::fromStdString(input.status().endpoint.host));
    if (!address.isNull() && !address.isLoopback() && !address.isMulticast()) {
        groups.listensOn(address);
    }
}

inline void tellGroups(Input& input, const GroupMemberships& groups) {
    input.setState(InputState::Listening, groups.text());
    input.setProblem(groups.problem());
}

/// Interfaces are asked for this often if the system does not report changes.
inline constexpr log::Duration kInterfacePause = std::chrono::seconds(3);

/// What the receiving thread runs. Created, used and destroyed in that thread; only stop() and wake() may be
/// called from others.
class ReceiveLoop {
public:
    virtual ~ReceiveLoop() = default;

    /// Opens the input's sockets, joins its groups and sets its port, buffer size and state. The error for a
    /// port in use does not name its holder: finding that takes time, and other sockets are waiting.
    virtual NetResult<void> add(const std::shared_ptr<Input>& input) = 0;

    /// Who is listened to from now on; the rest is counted and forgotten.
    virtual void listenTo(const AllowList& allowed) = 0;

    /// Reads what the input's sockets still hold and closes them.
    virtual void remove(InputId id) = 0;

    /// Receives until stop(), then reads what has already arrived.
    virtual void run() = 0;

    /// Makes an idle loop check the queues. From any thread.
    virtual void wake() = 0;

    void stop() {
        m_isStopping.store(true, std::memory_order_release);
        wake();
    }

protected:
    [[nodiscard]] bool isStopping() const { return m_isStopping.load(std::memory_order_acquire); }

    /// What comes first to a port that is opened again has PacketFlags::afterClosed.
    void noteClosed(std::uint16_t port) { m_closedPorts.insert(port); }
    [[nodiscard]] bool wasClosed(std::uint16_t port) const { return m_closedPorts.contains(port); }

private:
    std::set<std::uint16_t> m_closedPorts;
    std::atomic<bool> m_isStopping = false;
};

/// The loop of this path on this system.
[[nodiscard]] std::unique_ptr<ReceiveLoop> makeReceiveLoop(const ReceiveContext& context);

/// Linux: many datagrams per system call, written by the kernel straight into the log, with its stamps and
/// its drop counter.
[[nodiscard]] std::unique_ptr<ReceiveLoop> makeRecvmmsgLoop(const ReceiveContext& context);

} // namespace posewire::net
