// SPDX-License-Identifier: MIT
#include "core/model/session/session.h"

#include "core/model/session/accounts.h"

#include <algorithm>
#include <set>
#include <utility>

namespace posewire::model {

bool Session::forget(log::SenderId sender) {
    const auto passedOn = [&](const std::set<CharacterKey>& keys) {
        std::set<CharacterKey> heirs;
        for (const CharacterKey& key : keys) {
            heirs.insert(key.sender == sender ? atNow().roster().current(key) : key);
        }
        std::erase_if(heirs, [sender](const CharacterKey& key) { return key.sender == sender; });
        return heirs;
    };
    std::set<CharacterKey> hidden = passedOn(m_choices.hidden);
    std::set<CharacterKey> lifted = passedOn(m_choices.lifted);
    Selection selection = m_choices.selection;
    if (selection.character && selection.character->sender == sender) {
        selection.character = atNow().roster().current(*selection.character);
        selection.sender = selection.character->sender;
    }
    if (!m_ingest.forget(sender)) {
        return false;
    }
    m_choices.hidden = std::move(hidden);
    m_choices.lifted = std::move(lifted);
    m_choices.selection = selection.sender == sender ? Selection{} : selection;
    return true;
}

void Session::sharpenRange() {
    constexpr log::Duration kBefore = std::chrono::seconds(8); // enough to learn each stream despite a pause
    constexpr log::Duration kAfter = std::chrono::seconds(2);  // datagrams that are late have come
    constexpr std::uint64_t kMost = 200'000;                   // packets
    const std::optional<TimeRange>& range = m_choices.range.fixed;
    if (range != m_edges) {
        m_edges = range;
        m_isExact = {};
        m_ingest.setEdges(range.value_or(kAllTime));
        return;
    }
    for (std::size_t i = 0; range && !isBeingRead() && i < m_isExact.size(); ++i) {
        const log::Stamp edge = i == 0 ? range->from : range->to;
        const bool isPast = m_ingest.isFile() || edge + kAfter <= now();
        if (!isPast || std::exchange(m_isExact[i], true)) {
            continue;
        }
        log::Duration width = CountHistory::kFirstWidth;
        for (const Stream& stream : roster().streams()) {
            width = std::max(width, stream.accounting.resolution(edge));
        }
        const log::Stamp bucket = roundedDown(edge, width);
        const std::uint64_t first = packetFrom(bucket - kBefore);
        const std::uint64_t end = packetFrom(bucket + width + kAfter);
        const bool isKept = begin() == 0 || first > begin();
        if (isKept && end - first <= kMost) {
            m_ingest.cutAt(edge, {bucket, bucket + width}, first, end);
        }
    }
}

void Session::report(IncidentKind kind, log::Stamp now, words::Fact detail, log::SenderId sender) {
    Occurrence one = Occurrence::at(kind, sender, now, end() == 0 ? 0 : end() - 1);
    one.detail = std::move(detail);
    m_ingest.incidents().report(one);
}

} // namespace posewire::model
