// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/datagram_pacer.h"

#include "core/wire/type_table.h"

#include <algorithm>

namespace posewire::cli {

log::Duration DatagramPacer::due(wire::Bytes datagram, std::optional<log::Stamp> stamp) {
    m_now += step(datagram, stamp) / m_speed;
    return std::chrono::duration_cast<log::Duration>(m_now);
}

void DatagramPacer::beginAgain() {
    m_now += m_period / m_speed;
    m_stamp.reset();
    m_previous.reset();
}

DatagramPacer::Nanoseconds DatagramPacer::step(wire::Bytes datagram, std::optional<log::Stamp> stamp) {
    if (stamp) {
        const log::Stamp before = m_stamp.value_or(*stamp);
        m_stamp = stamp;
        return std::max(*stamp - before, log::Duration::zero());
    }
    const auto header = wire::decodeHeader(datagram);
    return header && wire::isSampled(header->type()) ? stepByHeader(*header) : Nanoseconds::zero();
}

DatagramPacer::Nanoseconds DatagramPacer::stepByHeader(const wire::Header& header) {
    constexpr std::chrono::seconds longestPause(2);
    const auto before = std::exchange(m_previous, header);
    if (!before || before->sampleCounter == header.sampleCounter) {
        return Nanoseconds::zero();
    }
    const std::chrono::milliseconds elapsed(header.timeCode - before->timeCode); // modulo 2³²
    return elapsed != elapsed.zero() && elapsed <= longestPause ? elapsed : m_period;
}

} // namespace posewire::cli
