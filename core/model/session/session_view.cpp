// SPDX-License-Identifier: MIT
#include "core/model/session/session_view.h"

#include "core/model/session/accounts.h"
#include "core/model/session/ingest.h"
#include "core/model/session/memory_figures.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"

#include <algorithm>

namespace posewire::model {
namespace {

/// One past the last packet before a stamp. If packets are missing, the next one that is there counts.
std::uint64_t endBefore(Ingest& ingest, log::Stamp stamp) {
    std::uint64_t first = ingest.begin();
    std::uint64_t last = ingest.end();
    while (first < last) {
        const std::uint64_t middle = first + (last - first) / 2;
        const auto packet = ingest.reader().packetFrom(middle);
        if (packet && packet->number < last && packet->stamp < stamp) {
            first = packet->number + 1;
        } else {
            last = middle;
        }
    }
    return first;
}

} // namespace

SessionView::SessionView(Ingest& ingest, const Choices& choices)
    : SessionView(Moment(ingest, choices, false), nullptr) {}

SessionView::SessionView(const Moment& moment, const SessionView* paused)
    : m_moment(moment),
      m_roster(std::make_unique<Roster>(moment)),
      m_accounts(std::make_unique<Accounts>(moment, *m_roster)),
      m_messages(std::make_unique<Messages>(moment, *m_roster)),
      m_verdicts(paused == nullptr ? std::make_unique<Verdicts>(*this, moment)
                                   : std::make_unique<Verdicts>(*this, moment, *paused->m_verdicts)),
      m_ownNow(paused == nullptr ? new SessionView(moment.now(), this) : nullptr) {}

SessionView::~SessionView() = default;

std::uint64_t SessionView::end() const {
    return m_moment.ingest().end();
}

std::uint64_t SessionView::begin() const {
    return m_moment.ingest().begin();
}

log::Stamp SessionView::now() const {
    return m_moment.ingest().now();
}

log::Stamp SessionView::knownUntil() const {
    return m_moment.ingest().knownUntil();
}

log::Duration SessionView::behind() const {
    return m_moment.ingest().behind();
}

log::Stamp SessionView::firstStamp() const {
    return m_moment.ingest().firstStamp();
}

log::Stamp SessionView::keptSince() const {
    const auto oldest = begin() != 0 ? packet(begin()) : std::nullopt;
    return oldest ? std::max(oldest->stamp, firstStamp()) : firstStamp();
}

bool SessionView::isBeingRead() const {
    return m_moment.ingest().isBeingRead();
}

bool SessionView::isRecording() const {
    return m_moment.ingest().isFile();
}

const log::PacketLog& SessionView::log() const {
    return m_moment.ingest().log();
}

MemoryFigures SessionView::memory() const {
    const std::size_t past = m_ownNow != nullptr ? m_ownNow->m_messages->memoryBytes() : 0;
    return memoryOf(m_moment.ingest(), m_messages->memoryBytes() + past);
}

std::uint64_t SessionView::packetFrom(log::Stamp stamp) const {
    const auto packet = m_moment.ingest().reader().packetFrom(endBefore(m_moment.ingest(), stamp));
    return packet ? std::min(packet->number, end()) : end();
}

std::uint64_t SessionView::packetAt(log::Stamp stamp) const {
    const std::uint64_t after = endBefore(m_moment.ingest(), stamp + log::Duration(1));
    return after == begin() ? after : after - 1;
}

std::optional<TimeRange> SessionView::range() const {
    const auto& [last, fixed, isSinceReset] = choices().range;
    if (isSinceReset) {
        return TimeRange{choices().reset, std::max(choices().reset, cursorStamp() + log::Duration(1))};
    }
    if (fixed || last <= log::Duration::zero()) {
        return fixed;
    }
    // What arrives at this very moment belongs to it.
    const log::Stamp end = cursorStamp() + log::Duration(1);
    return TimeRange{end - last, end};
}

} // namespace posewire::model
