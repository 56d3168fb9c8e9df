// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/tcp_peer.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace posewire::net {

/// The connections of one listener, Receiver::kMostPeers at most: who is let in, who gives way, and what is
/// told of it. Of one thread, as TcpInput.
class TcpRoom {
public:
    TcpRoom(const TcpContext& context, std::shared_ptr<Input> input)
        : m_context(context), m_input(std::move(input)) {}

    /// `socket` has connected to `localPort`. Lets it in, in the place of the one with the least claim where
    /// there is no other, or closes it.
    void admit(std::unique_ptr<QTcpSocket> socket, std::uint16_t localPort);

    // As of TcpInput.
    bool turn(log::Moment now);
    [[nodiscard]] std::optional<log::Moment> due() const { return m_publish; }
    void drain();
    void heedAllowed();

    /// Shows the connections in the input's status.
    void publish();

private:
    bool makeRoom();
    [[nodiscard]] std::string note() const;

    const TcpContext& m_context;
    std::shared_ptr<Input> m_input;
    std::vector<std::unique_ptr<TcpPeer>> m_peers;
    bool m_hasChanged = false;            ///< who is connected, since the last publish()
    std::uint64_t m_closed = 0;           ///< to make room
    std::uint64_t m_tooMany = 0;          ///< refused because there was none
    std::uint64_t m_elsewhere = 0;        ///< from those who are not listened to
    std::optional<log::Moment> m_publish; ///< when to publish the peers' counters next
};

} // namespace posewire::net
