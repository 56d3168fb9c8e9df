// SPDX-License-Identifier: MIT
#include "core/performer/streamed_truth.h"

namespace posewire::performer {

void StreamedTruth::add(const Sending& sending) {
    m_size += sending.bytes.size();
    m_sent.push_back({m_size, sending.due, sending.origin});
    m_framer.push(sending.bytes, [this](const log::TcpFramer::Piece& piece) { take(piece); });
}

void StreamedTruth::finish() {
    m_framer.finish([this](const log::TcpFramer::Piece& piece) { take(piece); });
}

void StreamedTruth::take(const log::TcpFramer::Piece& piece) {
    while (m_sent.size() > 1 && m_sent.front().end <= piece.offset) {
        m_sent.pop_front();
    }
    if (piece.kind == log::TcpFramer::Kind::Datagram) {
        m_truth.add({{piece.bytes.begin(), piece.bytes.end()}, m_sent.front().due, m_sent.front().origin});
    }
}

} // namespace posewire::performer
