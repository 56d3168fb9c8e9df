// SPDX-License-Identifier: MIT
#include "core/model/session/moment.h"

#include "core/model/session/choices.h"
#include "core/model/session/ingest.h"

#include <algorithm>

namespace posewire::model {

bool Moment::isPaused() const {
    return !m_isNow && m_choices->cursor.mode == Cursor::Mode::Paused;
}

std::uint64_t Moment::end() const {
    return isPaused() ? std::min(m_ingest->end(), m_choices->cursor.packet + 1) : m_ingest->end();
}

std::optional<log::Packet> Moment::packet(std::uint64_t number) const {
    return m_ingest->reader().packet(number);
}

const log::StreamEntries* Moment::entriesOf(const log::StreamKey& key) const {
    return m_ingest->counting().index().find(key);
}

std::size_t Moment::countOf(const log::StreamEntries& entries) const {
    const std::uint64_t end = this->end();
    const auto newest = end != 0 ? entries.atOrBeforePacket(end - 1) : std::nullopt;
    return newest ? *newest + 1 : 0;
}

log::Stamp Moment::stamp() const {
    return pausedStamp().value_or(m_ingest->now());
}

std::optional<log::Stamp> Moment::pausedStamp() const {
    if (!isPaused()) {
        return std::nullopt;
    }
    const auto shown = packet(m_choices->cursor.packet);
    return shown ? shown->stamp : m_ingest->now();
}

} // namespace posewire::model
