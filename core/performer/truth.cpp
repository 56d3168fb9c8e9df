// SPDX-License-Identifier: MIT
#include "core/performer/truth.h"

namespace posewire::performer {

void Truth::add(const Sending& sending) {
    if (!wire::startsWithMagic(sending.bytes)) {
        ++m_source.foreign;
        return;
    }
    m_source.bytes += sending.bytes.size();
    if (!wire::decodeInto(sending.bytes, m_scratch)) {
        ++m_source.malformed;
        return;
    }
    ++m_source.datagrams;
    const wire::Header& header = m_scratch.header;
    m_streams[{header.character, header.type()}].add(header, sending);
}

} // namespace posewire::performer
