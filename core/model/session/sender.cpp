// SPDX-License-Identifier: MIT
#include "core/model/session/sender.h"

#include "core/log/ip_packet.h"
#include "core/wire/text.h"
#include "core/wire/type_table.h"

#include <algorithm>

namespace posewire::model {

void Sender::takeMalformed(log::Stamp stamp) {
    ++malformed;
    history.add(stamp, {.malformed = 1});
}

void Sender::takeForeign(wire::Bytes datagram) {
    constexpr std::size_t kKept = 16;
    ++foreign;
    foreignBytes += datagram.size();
    const wire::Bytes head = datagram.first(std::min(datagram.size(), kKept));
    foreignHead.assign(head.begin(), head.end());
}

std::optional<std::string> Sender::host() const {
    if (info.transport == log::Transport::File) {
        return std::nullopt;
    }
    return std::string(log::nameOf(info.transport)) + ' ' + std::string(log::hostOf(info.address));
}

std::string Sender::foreignText() const {
    std::string text;
    for (const std::byte& byte : foreignHead) {
        text += (text.empty() ? "" : " ") + wire::hexadecimal({&byte, 1});
    }
    return text;
}

LengthUnit Sender::positionUnit(std::uint8_t type) const {
    if (!countsSamples(type)) {
        return LengthUnit::Metre;
    }
    const wire::TypeInfo* row = wire::findType(type);
    return row != nullptr && row->frame == wire::Frame::YUp ? detector.result().yUpUnit : positionUnit();
}

std::uint64_t Character::counterRestarts() const {
    std::uint64_t restarts = 0;
    for (const Stream* stream : streams) { // all restart together
        restarts = std::max(restarts, stream->accounting.counts().restarts);
    }
    return restarts;
}

} // namespace posewire::model
