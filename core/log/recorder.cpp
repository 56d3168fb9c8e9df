// SPDX-License-Identifier: MIT
#include "core/log/recorder.h"

#include "core/log/packet_log.h"

#include <algorithm>
#include <utility>

namespace posewire::log {

Recorder::Recorder(const PacketLog& log, ByteSink& sink, std::uint64_t from)
    : m_log(log), m_sink(sink), m_reader(log), m_writer(sink), m_next(std::max(from, m_reader.begin())) {}

Recorder::Result Recorder::begin(const RecordingInfo& info) {
    const auto begun = m_writer.begin(info);
    return begun ? m_sink.flush() : begun;
}

Recorder::Result Recorder::follow() {
    const std::uint64_t before = m_next;
    const auto written = writeNew();
    return written && m_next != before ? m_sink.flush() : written;
}

Recorder::Result Recorder::finish() {
    if (auto written = writeNew(); !written) {
        return written;
    }
    const auto ended = m_writer.finish();
    return ended ? m_sink.flush() : ended;
}

Recorder::Result Recorder::writeNew() {
    m_reader.refresh();
    for (; m_next < m_reader.end(); ++m_next) {
        auto packet = m_reader.packet(m_next);
        const SenderInfo* sender = packet ? m_log.senders().find(packet->sender) : nullptr;
        if (sender == nullptr) {
            ++m_missed;
            ++m_missedBeforeNext;
            continue;
        }
        const std::uint64_t drops = packet->kernelDropsBefore + std::exchange(m_missedBeforeNext, 0);
        packet->kernelDropsBefore =
            static_cast<std::uint32_t>(std::min<std::uint64_t>(drops, std::uint64_t{UINT32_MAX}));
        if (auto added = m_writer.add(*packet, *sender); !added) {
            return added;
        }
    }
    return {};
}

} // namespace posewire::log
