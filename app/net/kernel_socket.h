// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/allow_list.h"
#include "core/log/log_writer.h"
#include "core/log/sender_table.h"
#include "core/log/system_files.h"
#include "core/log/time.h"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// A UDP socket of Linux as the receiving thread uses it.
namespace posewire::net {

/// Has the kernel give stamps and its drop counter with each datagram; where it refuses, stamps come from the
/// clock.
void prepare(int descriptor);

/// Joins a multicast group on an interface, or leaves it there; empty, or what the system says against it.
[[nodiscard]] std::string changeMembership(int descriptor, const QHostAddress& group, int interface,
                                           bool joins);

struct SocketMemory {
    std::uint32_t drops = 0; ///< datagrams lost since it was opened, modulo 2³²
    std::uint32_t usedBytes = 0;
    std::uint32_t bufferBytes = 0;
};
[[nodiscard]] std::optional<SocketMemory> memoryOf(int descriptor);

struct Received {
    std::size_t size = 0;
    log::WallTime time{}; ///< the kernel's; log::WallTime() if it gave none
    /// Datagrams the socket had dropped when this one was queued, modulo 2³²; 0 if none.
    std::uint32_t drops = 0;
    bool isTruncated = false;
};

/// The arguments of recvmmsg for the lanes of a log, and its results. One for each socket, so that addresses
/// that it leaves unwritten stay zero.
class MessageBatch {
public:
    MessageBatch();
    MessageBatch(const MessageBatch&) = delete;
    MessageBatch& operator=(const MessageBatch&) = delete;

    /// Receives what has arrived, at most one datagram per lane, without blocking. Returns the number of
    /// datagrams, 0 on an error too.
    std::size_t receive(int descriptor, std::span<const log::LogWriter::Lane> lanes);

    [[nodiscard]] Received received(std::size_t index) const;
    [[nodiscard]] const sockaddr_in6& sender(std::size_t index) const { return m_senders[index]; }

private:
    static constexpr std::size_t kControlSize =
        CMSG_SPACE(sizeof(timespec)) + CMSG_SPACE(sizeof(std::uint32_t));
    struct alignas(cmsghdr) Control {
        std::array<std::byte, kControlSize> bytes;
    };

    std::array<mmsghdr, log::LogWriter::kLaneLimit> m_messages{};
    std::array<std::array<iovec, 2>, log::LogWriter::kLaneLimit> m_parts{};
    std::array<sockaddr_in6, log::LogWriter::kLaneLimit> m_senders{};
    std::array<Control, log::LogWriter::kLaneLimit> m_controls{};
};

/// Maps the kernel's form of an address to the sender's id, without formatting text for recent senders; of
/// those who are not listened to it knows only that. One for each socket.
class SenderCache {
public:
    using Id = std::optional<log::SenderId>; ///< nothing for one who is not listened to

    SenderCache(log::SenderTable& table, std::uint16_t localPort, const AllowList& allowed)
        : m_table(&table), m_localPort(localPort), m_allowed(&allowed), m_entries(kEntries) {}

    /// `address` is IPv4 or IPv6; all other families count as one sender.
    Id idOf(const sockaddr_in6& address) {
        const bool isLast = m_last != nullptr && std::memcmp(&m_last->address, &address, sizeof address) == 0;
        return isLast ? m_last->id : look(address);
    }

    /// Asks for everyone again: the list of those who are listened to has changed.
    void forget() {
        m_last = nullptr;
        m_entries.assign(kEntries, {});
    }

private:
    static constexpr std::size_t kEntries = 64;
    struct Entry {
        sockaddr_in6 address{};
        Id id{};
        log::SenderTable::Held held{}; ///< so that the number stays
    };

    Id look(const sockaddr_in6& address);

    log::SenderTable* m_table;
    std::uint16_t m_localPort;
    const AllowList* m_allowed;
    std::vector<Entry> m_entries; ///< one slot for each hash; a newcomer replaces the old entry
    const Entry* m_last = nullptr;
};

/// Hears from Linux that interfaces or their addresses have changed, without asking for them.
class InterfaceWatch {
public:
    InterfaceWatch();

    /// Readable when something has changed; -1 if the system tells nothing.
    [[nodiscard]] int descriptor() const { return m_socket.number(); }

    /// True if something has changed since the last call. One system call, which does not block.
    [[nodiscard]] bool hasChanged();

private:
    log::Descriptor m_socket;
};

} // namespace posewire::net
