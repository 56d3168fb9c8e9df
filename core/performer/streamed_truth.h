// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/tcp_framer.h"
#include "core/log/time.h"
#include "core/performer/truth.h"

#include <deque>

namespace posewire::performer {

/// The same as Truth for a byte stream such as TCP, in which a damaged datagram can take the next with it:
/// the framer finds where datagrams begin and end.
class StreamedTruth {
public:
    void add(const Sending& sending);
    /// The stream has ended.
    void finish();

    [[nodiscard]] const Truth& truth() const { return m_truth; }
    [[nodiscard]] std::uint64_t skippedBytes() const { return m_framer.skippedBytes(); }

private:
    struct Sent {
        std::uint64_t end = 0; ///< bytes of the stream up to the end of it
        log::Duration due{};
        Origin origin;
    };
    void take(const log::TcpFramer::Piece& piece);

    log::TcpFramer m_framer;
    Truth m_truth;
    std::deque<Sent> m_sent; ///< of which not everything has come out yet
    std::uint64_t m_size = 0;
};

} // namespace posewire::performer
