// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"

#include <optional>
#include <string>
#include <string_view>

namespace posewire::log {

/// What a recording says about a packet besides what its IP and UDP headers can. It is in the first
/// comment of the packet, in words: "Posewire: TCP; stamped on reading; from [fe80::1%eth0]:40001".
struct RecordedOrigin {
    Transport transport = Transport::Udp;
    PacketFlags flags{.stampedByKernel = true};
    std::optional<std::string> address{}; ///< nothing where the headers have it

    friend bool operator==(const RecordedOrigin&, const RecordedOrigin&) = default;
};

[[nodiscard]] std::string originText(const RecordedOrigin& origin);

/// The inverse; nothing where somebody else wrote the comment.
[[nodiscard]] std::optional<RecordedOrigin> parseOrigin(std::string_view comment);

} // namespace posewire::log
