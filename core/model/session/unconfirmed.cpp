// SPDX-License-Identifier: MIT
#include "core/model/session/unconfirmed.h"

#include "core/model/accounting/probation.h"
#include "core/model/accounting/stream_counts.h"

#include <algorithm>
#include <optional>

namespace posewire::model {

bool Unconfirmed::take(const CharacterKey& key, const log::Packet& packet, const wire::Header& header) {
    if (m_seen.size() >= kMost && !m_seen.contains(key)) {
        m_seen.clear();
    }
    std::vector<Seen>& seen = m_seen[key];
    std::erase_if(
        seen, [&](const Seen& other) { return std::chrono::abs(packet.stamp - other.stamp) > kTogether; });
    seen.push_back({packet.stamp, header.sampleCounter, header.type()});
    const bool isBelieved = seen.size() >= kMany || isCounted(seen);
    if (isBelieved) {
        m_seen.erase(key);
    }
    return isBelieved;
}

/// Whether the newest samples of the newest type are equally far apart, as a sender counts them: those that
/// corruption puts there are not. Of messages without samples a few are enough.
bool Unconfirmed::isCounted(const std::vector<Seen>& seen) {
    const Seen& newest = seen.back();
    if (!countsSamples(newest.type)) {
        return std::ranges::count(seen, newest.type, &Seen::type) >= kMessages;
    }
    std::uint32_t sample = newest.sample;
    std::optional<std::uint32_t> spacing;
    std::size_t samples = 1;
    for (auto one = seen.rbegin(); one != seen.rend() && samples < kSamples; ++one) {
        if (one->type != newest.type || one->sample == sample) {
            continue;
        }
        const std::uint32_t moved = sample - one->sample;
        if (spacing.value_or(moved) != moved || moved > static_cast<std::uint32_t>(Probation::kMostForward)) {
            return false;
        }
        spacing = moved;
        sample = one->sample;
        ++samples;
    }
    return samples == kSamples;
}

void Unconfirmed::retire(log::SenderId sender) {
    std::erase_if(m_seen, [sender](const auto& entry) { return entry.first.sender == sender; });
}

} // namespace posewire::model
