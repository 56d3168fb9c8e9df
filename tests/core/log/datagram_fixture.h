// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/codec.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace posewire::log {

using ByteVector = std::vector<std::byte>;

inline ByteVector bytesOfDatagram(const wire::Body& body, std::uint32_t sample = 1,
                                  wire::HeaderEra era = wire::HeaderEra::Counted) {
    wire::Datagram datagram;
    datagram.header.sampleCounter = sample;
    datagram.body = body;
    wire::completeHeader(datagram, era);
    return wire::encode(datagram).value_or(ByteVector{});
}

/// 24 + segments × 32 bytes.
inline ByteVector poseDatagram(std::uint32_t sample, std::size_t segments = 23,
                               wire::HeaderEra era = wire::HeaderEra::Counted) {
    wire::PoseQuaternion pose;
    for (std::size_t i = 0; i < segments; ++i) {
        const auto k = static_cast<float>(i);
        pose.segments.push_back({static_cast<std::uint32_t>(i + 1), {k, 0.5F * k, 1.0F}, {1, 0, 0, 0}});
    }
    return bytesOfDatagram(pose, sample, era);
}

inline ByteVector textBytes(const std::string& text) {
    ByteVector bytes;
    for (const char character : text) {
        bytes.push_back(static_cast<std::byte>(character));
    }
    return bytes;
}

inline ByteVector joined(const std::vector<ByteVector>& parts) {
    ByteVector whole;
    for (const ByteVector& part : parts) {
        whole.insert(whole.end(), part.begin(), part.end());
    }
    return whole;
}

/// Sets header bytes 22–23.
inline ByteVector withPayloadSize(ByteVector datagram, std::uint16_t size) {
    datagram[22] = static_cast<std::byte>(size >> 8);
    datagram[23] = static_cast<std::byte>(size & 0xff);
    return datagram;
}

} // namespace posewire::log
