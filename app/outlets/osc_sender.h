// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/net/datagram_sender.h"
#include "core/log/time.h"

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <variant>

namespace posewire::outlets {

using OscValue = std::variant<std::int32_t, float, std::string>;

/// Sends messages in bundles of Open Sound Control 1.0 by UDP. Belongs to one thread.
class OscSender {
public:
    /// Of a bundle: what fits into a frame of Ethernet with the headers of IPv4 and UDP. More messages come
    /// in further bundles of the same time.
    static constexpr std::size_t kMostBytes = 1'472;

    [[nodiscard]] static net::NetResult<OscSender> connect(const std::string& place);

    /// Begins a bundle with that time tag; what was added before is sent.
    void begin(log::WallTime time);
    void add(const std::string& address, std::initializer_list<OscValue> values);
    void finish();

    [[nodiscard]] const std::string& place() const { return m_place; }
    [[nodiscard]] std::uint64_t sent() const { return m_sender.sent(); }       ///< datagrams
    [[nodiscard]] std::uint64_t refused() const { return m_sender.refused(); } ///< by this system

private:
    struct FreeBundle {
        void operator()(void* bundle) const;
    };

    OscSender(net::DatagramSender sender, std::string place)
        : m_sender(std::move(sender)), m_place(std::move(place)) {}

    net::DatagramSender m_sender;
    std::string m_place;
    log::WallTime m_time{};
    std::unique_ptr<void, FreeBundle> m_bundle; ///< of liblo; null while nothing is in it
};

} // namespace posewire::outlets
