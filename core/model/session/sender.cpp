// SPDX-License-Identifier: MIT
#include "core/model/session/sender.h"

#include "core/wire/messages.h"

#include <algorithm>
#include <string_view>

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

std::string Sender::foreignText() const {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text;
    for (const std::byte byte : foreignHead) {
        text += text.empty() ? "" : " ";
        text += kDigits[std::to_integer<unsigned>(byte) >> 4];
        text += kDigits[std::to_integer<unsigned>(byte) & 0xf];
    }
    return text;
}

LengthUnit Sender::positionUnit(std::uint8_t type) const {
    switch (type) {
    case wire::PoseEuler::kType:
    case wire::PointPositions::kType:
    case wire::TagPositions::kType:
        return detector.result().yUpUnit;
    case wire::NullPose::kType:
        return LengthUnit::Metre;
    default:
        return positionUnit();
    }
}

} // namespace posewire::model
