// SPDX-License-Identifier: MIT
#include "core/model/session/unconfirmed.h"

#include "core/model/accounting/probation.h"
#include "core/model/accounting/stream_counts.h"

#include <algorithm>
#include <cstdlib>

namespace posewire::model {

bool Unconfirmed::take(const CharacterKey& key, const log::Packet& packet, const wire::Header& header) {
    if (m_seen.size() >= kMost && !m_seen.contains(key)) {
        m_seen.clear();
    }
    std::vector<Seen>& seen = m_seen[key];
    const Seen one{packet.stamp, header.sampleCounter, countsSamples(header.type())};
    std::erase_if(seen, [&](const Seen& other) {
        const auto moved = static_cast<std::int32_t>(one.sample - other.sample);
        const bool isFar = one.isSampled && other.isSampled && std::abs(moved) > Probation::kMostForward;
        return isFar || std::chrono::abs(one.stamp - other.stamp) > kTogether;
    });
    seen.push_back(one);
    if (seen.size() < kNeeded) {
        return false;
    }
    m_seen.erase(key);
    return true;
}

void Unconfirmed::retire(log::SenderId sender) {
    std::erase_if(m_seen, [sender](const auto& entry) { return entry.first.sender == sender; });
}

} // namespace posewire::model
