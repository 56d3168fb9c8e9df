// SPDX-License-Identifier: MIT
#pragma once

#include "tests/core/performer/faulty_performance.h"

#include "core/log/packet_log.h"
#include "core/model/accounting/stream_accounting.h"
#include "core/wire/type_table.h"

#include <map>
#include <vector>

namespace posewire::performer {

using namespace std::chrono_literals;

/// What the receiver makes of it.
struct Received {
    std::map<Truth::StreamKey, model::StreamAccounting> streams;
    SenderFigures sender;
};

inline void receive(const log::Packet& packet, Received& received) {
    if (!wire::startsWithMagic(packet.bytes)) {
        ++received.sender.foreign;
        return;
    }
    received.sender.bytes += packet.bytes.size();
    const auto datagram = wire::decode(packet.bytes);
    if (!datagram) {
        ++received.sender.malformed;
        return;
    }
    ++received.sender.datagrams;
    const wire::Header& header = datagram->header;
    auto& stream =
        received.streams.try_emplace({header.character, header.type()}, header.type()).first->second;
    stream.add(packet, header);
}

inline Received receiveAll(const std::vector<Sending>& sendings) {
    constexpr log::Stamp start(1'700'000'000s);
    log::PacketLog log;
    const log::SenderId sender = log.senders().intern({"127.0.0.1:40001", log::Transport::Udp, 9763});
    for (const Sending& sending : sendings) {
        log::Arrival arrival;
        arrival.stamp = start + sending.due;
        arrival.sender = sender;
        log.writer().append(sending.bytes, arrival);
    }
    log.writer().publish();
    log::LogReader reader(log);
    reader.refresh();
    Received received;
    for (auto number = reader.begin(); number != reader.end(); ++number) {
        if (const auto packet = reader.packet(number)) {
            receive(*packet, received);
        }
    }
    return received;
}

inline SentFigures figuresOf(const model::StreamCounts& counts, std::uint8_t type) {
    SentFigures figures;
    figures.datagrams = counts.datagrams;
    figures.incomplete = counts.incomplete;
    figures.duplicates = counts.duplicates;
    if (wire::isSampled(type)) {
        figures.samples = counts.samples;
        figures.lost = counts.lost;
        figures.reordered = counts.reordered;
        figures.late = counts.late;
        figures.restarts = counts.restarts;
        figures.step = counts.step;
        figures.firstSample = counts.firstSample;
        figures.lastSample = counts.lastSample;
    }
    return figures;
}

} // namespace posewire::performer
