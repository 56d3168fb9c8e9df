// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/log/time.h"
#include "core/model/keys.h"
#include "core/wire/header.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace posewire::model {

/// Characters of which a sender has sent so little that a corrupt header may have invented them: they are
/// believed once datagrams agree with each other.
class Unconfirmed {
public:
    /// Samples of one type that are equally far apart are no accident, nor are messages without samples.
    static constexpr std::size_t kSamples = 5;
    static constexpr std::ptrdiff_t kMessages = 3;
    /// So many datagrams are none in any case.
    static constexpr std::size_t kMany = 64;
    static constexpr log::Duration kTogether = std::chrono::seconds(5);
    static constexpr std::size_t kMost = 256;

    /// A datagram of such a character. True where it is believed with this one.
    bool take(const CharacterKey& key, const log::Packet& packet, const wire::Header& header);

    void retire(log::SenderId sender);

private:
    struct Seen {
        log::Stamp stamp{};
        std::uint32_t sample = 0;
        std::uint8_t type = 0;
    };
    [[nodiscard]] static bool isCounted(const std::vector<Seen>& seen);

    std::map<CharacterKey, std::vector<Seen>> m_seen;
};

} // namespace posewire::model
