// SPDX-License-Identifier: MIT
#include "core/export/motion/part_joiner.h"

#include <algorithm>

namespace posewire::exporting {

PartJoiner::Open& PartJoiner::openFor(const wire::Header& header, log::Stamp stamp) {
    const auto found = std::find_if(m_open.rbegin(), m_open.rend(), [&](const Open& one) {
        return one.sample == header.sampleCounter && one.type == header.type();
    });
    if (found != m_open.rend()) {
        return *found;
    }
    while (!m_open.empty() && (stamp - m_open.front().stamp > kWait || m_open.size() == kMostOpen)) {
        m_open.pop_front();
    }
    m_open.push_back({header.sampleCounter, header.type(), stamp, 0, 0, {}});
    return m_open.back();
}

const wire::Datagram* PartJoiner::add(const wire::Datagram& part, const log::Packet& packet) {
    const wire::Header& header = part.header;
    if (header.isLast() && header.datagramIndex() == 0) {
        return &part;
    }
    Open& open = openFor(header, packet.stamp);
    open.bytes += packet.bytes.size();
    if (open.bytes > kMostBytes) {
        return nullptr;
    }
    open.parts.try_emplace(header.datagramIndex(), part);
    if (header.isLast()) {
        open.expected = header.datagramIndex() + std::size_t{1};
    }
    if (open.parts.size() != open.expected) {
        return nullptr;
    }
    m_whole = std::move(open.parts.begin()->second);
    open.parts.erase(open.parts.begin());
    for (const auto& [index, next] : open.parts) {
        wire::appendPart(m_whole, next);
    }
    std::erase_if(m_open, [&](const Open& one) { return &one == &open; });
    return &m_whole;
}

} // namespace posewire::exporting
