// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/datagram_pacer.h"

#include "core/wire/type_table.h"

#include <algorithm>

namespace posewire::cli {

std::int64_t DatagramPacer::due(wire::Bytes datagram, std::optional<std::int64_t> stampNs) {
    m_nowNs += step(datagram, stampNs) / m_speed;
    return static_cast<std::int64_t>(m_nowNs);
}

void DatagramPacer::beginAgain() {
    m_nowNs += m_periodNs / m_speed;
    m_stampNs.reset();
    m_previous.reset();
}

double DatagramPacer::step(wire::Bytes datagram, std::optional<std::int64_t> stampNs) {
    if (stampNs) {
        const std::int64_t before = m_stampNs.value_or(*stampNs);
        m_stampNs = stampNs;
        return static_cast<double>(std::max<std::int64_t>(*stampNs - before, 0));
    }
    const auto header = wire::decodeHeader(datagram);
    return header && wire::isSampled(header->type()) ? stepByHeader(*header) : 0.0;
}

double DatagramPacer::stepByHeader(const wire::Header& header) {
    constexpr std::uint32_t longestPauseMs = 2000;
    const auto before = std::exchange(m_previous, header);
    if (!before || before->sampleCounter == header.sampleCounter) {
        return 0.0;
    }
    const std::uint32_t elapsedMs = header.timeCode - before->timeCode;
    return elapsedMs != 0 && elapsedMs <= longestPauseMs ? elapsedMs * 1e6 : m_periodNs;
}

} // namespace posewire::cli
