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
    /// This many that agree are no accident.
    static constexpr std::size_t kNeeded = 3;
    static constexpr log::Duration kTogether = std::chrono::seconds(5);
    static constexpr std::size_t kMost = 256;

    /// A datagram of such a character. True where it is believed with this one.
    bool take(const CharacterKey& key, const log::Packet& packet, const wire::Header& header);

    void retire(log::SenderId sender);

private:
    struct Seen {
        log::Stamp stamp{};
        std::uint32_t sample = 0;
        bool isSampled = false;
    };
    std::map<CharacterKey, std::vector<Seen>> m_seen;
};

} // namespace posewire::model
