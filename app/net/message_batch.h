// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/log_writer.h"
#include "core/log/time.h"

#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace posewire::net {

/// What the kernel reports about one datagram besides its bytes.
struct Received {
    std::size_t size = 0;
    log::Stamp stamp{}; ///< the kernel's; log::Stamp() if it gave none
    std::uint32_t drops =
        0; ///< datagrams the socket had dropped when this one was queued, modulo 2³²; 0 where none
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

} // namespace posewire::net
