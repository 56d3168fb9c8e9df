// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/message_batch.h"

#include <algorithm>
#include <cstring>
#include <ctime>

namespace posewire::net {

MessageBatch::MessageBatch() {
    for (std::size_t i = 0; i < m_messages.size(); ++i) {
        msghdr& header = m_messages[i].msg_hdr;
        header.msg_name = &m_senders[i];
        header.msg_iov = m_parts[i].data();
        header.msg_iovlen = m_parts[i].size();
        header.msg_control = m_controls[i].bytes.data();
    }
}

std::size_t MessageBatch::receive(int descriptor, std::span<const log::LogWriter::Lane> lanes) {
    for (std::size_t i = 0; i < lanes.size(); ++i) {
        m_parts[i][0] = {lanes[i].bytes.data(), lanes[i].bytes.size()};
        m_parts[i][1] = {lanes[i].spill.data(), lanes[i].spill.size()};
        msghdr& header = m_messages[i].msg_hdr;
        header.msg_namelen = sizeof(sockaddr_in6);
        header.msg_controllen = kControlSize;
    }
    const int count =
        ::recvmmsg(descriptor, m_messages.data(), static_cast<unsigned>(lanes.size()), MSG_DONTWAIT, nullptr);
    return count < 0 ? 0 : static_cast<std::size_t>(count);
}

Received MessageBatch::received(std::size_t index) const {
    const msghdr& header = m_messages[index].msg_hdr;
    Received received;
    received.size = m_messages[index].msg_len;
    received.isTruncated = (header.msg_flags & MSG_TRUNC) != 0;
    // By hand, since CMSG_NXTHDR is a call into the library for each message, and there are very many here.
    const std::byte* const controls = m_controls[index].bytes.data();
    for (std::size_t at = 0; at + sizeof(cmsghdr) <= header.msg_controllen;) {
        cmsghdr control{};
        std::memcpy(&control, controls + at, sizeof control);
        const std::byte* const data = controls + at + CMSG_LEN(0);
        if (control.cmsg_level == SOL_SOCKET && control.cmsg_type == SO_TIMESTAMPNS) {
            timespec stamp{};
            std::memcpy(&stamp, data, sizeof stamp);
            received.stamp =
                log::Stamp(std::chrono::seconds(stamp.tv_sec) + std::chrono::nanoseconds(stamp.tv_nsec));
        } else if (control.cmsg_level == SOL_SOCKET && control.cmsg_type == SO_RXQ_OVFL) {
            std::memcpy(&received.drops, data, sizeof received.drops);
        }
        at += std::max(CMSG_ALIGN(control.cmsg_len), sizeof(cmsghdr));
    }
    return received;
}

} // namespace posewire::net
