// SPDX-License-Identifier: MIT
#include "core/performer/truth.h"

namespace posewire::performer {

void Truth::add(const Sending& sending) {
    if (!wire::startsWithMagic(sending.bytes)) {
        ++m_sender.foreign;
        return;
    }
    m_sender.bytes += sending.bytes.size();
    if (!wire::decodeInto(sending.bytes, m_scratch)) {
        ++m_sender.malformed;
        return;
    }
    ++m_sender.datagrams;
    const wire::Header& header = m_scratch.header;
    m_streams[{header.character, header.type()}].add(header, sending);
}

} // namespace posewire::performer
