// SPDX-License-Identifier: MIT
#include "core/model/session/sender.h"

#include "core/log/ip_packet.h"
#include "core/model/accounting/other_formats.h"
#include "core/wire/text.h"
#include "core/wire/type_table.h"

#include <algorithm>

namespace posewire::model {
namespace {

wire::Bytes shownOf(const std::vector<std::byte>& head) {
    constexpr std::size_t kShown = 16;
    return wire::Bytes(head).first(std::min(head.size(), kShown));
}

} // namespace

void Sender::takeMalformed(log::Stamp stamp) {
    ++malformed;
    history.add(stamp, {.malformed = 1});
}

void Sender::takeForeign(wire::Bytes datagram) {
    ++foreign;
    foreignBytes += datagram.size();
    const wire::Bytes head = datagram.first(std::min(datagram.size(), log::kLookedAt));
    foreignHead.assign(head.begin(), head.end());
}

void Sender::takeSkipped(wire::Bytes between) {
    if (datagrams == 0 && skippedBytes == foreignHead.size()) {
        const wire::Bytes more = between.first(std::min(between.size(), log::kLookedAt - foreignHead.size()));
        foreignHead.insert(foreignHead.end(), more.begin(), more.end());
    }
    skippedBytes += between.size();
}

std::optional<std::string> Sender::host() const {
    if (info.transport == log::Transport::File) {
        return std::nullopt;
    }
    return std::string(log::nameOf(info.transport)) + ' ' + info.probe + ' ' +
           std::string(log::hostOf(info.address));
}

std::string Sender::foreignText() const {
    std::string text;
    for (const std::byte& byte : shownOf(foreignHead)) {
        text += (text.empty() ? "" : " ") + wire::hexadecimal({&byte, 1});
    }
    return text;
}

words::Fact Sender::foreignFormat() const {
    return looksLike(foreignHead);
}

words::Fact Sender::foreignFact() const {
    std::string value = foreignText() + "  ";
    for (const std::byte byte : shownOf(foreignHead)) {
        const auto character = std::to_integer<char>(byte);
        value += character >= ' ' && character <= '~' ? character : '.'; // as dumps have it
    }
    return {words::Kind::ForeignDatagrams,
            {{"n", foreign}, {"address", address().shown()}, {"value", value}, {"looks", foreignFormat()}}};
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
