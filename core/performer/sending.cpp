// SPDX-License-Identifier: MIT
#include "core/performer/sending.h"

#include "core/wire/codec.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace posewire::performer {
namespace {

constexpr int kTries = 16;
constexpr std::uint64_t kKeysPerDatagram = 4096;
/// Further from every other counter than any loss, delay or restart.
constexpr std::int64_t kFar = 1'000'000;
/// Up to this far ahead, the samples in between are reordered but clearly not late.
constexpr double kNearMs = 20.0;
/// Less than a jump back that could be a restart.
constexpr std::int64_t kClearlyBack = 90;

std::uint64_t flip(std::vector<std::byte>& bytes, const KeyedRandom& random, std::uint64_t key) {
    const std::uint64_t count = 1 + random.bits(key) % 4;
    for (std::uint64_t flipped = 0; flipped < count; ++flipped) {
        const std::uint64_t bits = random.bits(++key);
        bytes[bits % bytes.size()] ^= static_cast<std::byte>(1 + (bits >> 32) % 255);
    }
    return key;
}

bool isClearCounter(const Origin& origin, std::uint32_t sample, double periodMs) {
    const std::int64_t moved = distance(sample, origin.sample);
    if (std::abs(moved) >= kFar) {
        return true;
    }
    const auto most = static_cast<std::int64_t>(std::floor(kNearMs / periodMs));
    return moved % origin.step == 0 && moved <= most && moved >= -kClearlyBack;
}

/// Whether there is one answer to what a datagram with this header counts as.
bool isClear(const wire::Header& original, const wire::Header& now, const Origin& origin,
             const CorruptionBounds& bounds) {
    const bool isSame = now.type() == original.type() && now.character == original.character &&
                        now.sampleCounter == original.sampleCounter;
    if (now.datagramCounter != original.datagramCounter) {
        return false;
    }
    if (isSame) {
        return true;
    }
    const bool mayBeOfType = bounds.mayChangeType || now.type() == original.type();
    return bounds.mayChangeIdentity && mayBeOfType && original.datagramCounter == 0x80 &&
           wire::isSampled(original.type()) && wire::isSampled(now.type()) &&
           isClearCounter(origin, now.sampleCounter, bounds.periodMs);
}

wire::Datagram partOf(const wire::Datagram& whole, std::size_t part, std::size_t parts) {
    wire::Datagram datagram{whole.header, whole.body, {}};
    const std::size_t items = wire::dividableItems(datagram.body);
    wire::keepItems(datagram.body, part * items / parts, (part + 1) * items / parts);
    const bool isCounted = whole.header.payloadSize != 0 || whole.header.countedSegments() != 0;
    completeHeader(datagram, isCounted ? wire::HeaderEra::Counted : wire::HeaderEra::Reserved);
    const bool isLast = part + 1 == parts;
    datagram.header.datagramCounter = static_cast<std::uint8_t>(part | (isLast ? 0x80U : 0U));
    return datagram;
}

} // namespace

void corrupt(Sending& sending, const CorruptionBounds& bounds, const KeyedRandom& random, std::uint64_t key) {
    const auto original = wire::decodeHeader(sending.bytes);
    if (!original || sending.bytes.empty()) {
        return;
    }
    const std::vector<std::byte> intact = sending.bytes;
    std::uint64_t next = key * kKeysPerDatagram;
    for (int attempt = 0; attempt < kTries; ++attempt) {
        sending.bytes = intact;
        next = flip(sending.bytes, random, next + 1);
        const auto now = wire::decode(sending.bytes);
        sending.isReadable = now.has_value();
        if (!now || isClear(*original, now->header, sending.origin, bounds)) {
            return;
        }
    }
    sending.bytes = intact;
    // Damage to the payload alone; where it cannot be decoded any more, that is clear too.
    if (sending.bytes.size() > wire::kHeaderSize) {
        const std::uint64_t bits = random.bits(next + 1);
        const std::size_t payload = sending.bytes.size() - wire::kHeaderSize;
        sending.bytes[wire::kHeaderSize + bits % payload] ^= static_cast<std::byte>(1 + (bits >> 32) % 255);
    }
    sending.isReadable = wire::decode(sending.bytes).has_value();
}

void truncate(Sending& sending, const KeyedRandom& random, std::uint64_t key) {
    if (!sending.bytes.empty()) {
        sending.bytes.resize(random.bits(key) % sending.bytes.size());
        sending.isReadable = wire::decode(sending.bytes).has_value();
    }
}

std::vector<std::vector<std::byte>> splitSample(std::span<const std::byte> datagram, std::size_t parts) {
    std::vector<std::vector<std::byte>> all;
    auto whole = wire::decode(datagram);
    const bool isWhole = whole && wire::isSampled(whole->header.type()) &&
                         whole->header.datagramIndex() == 0 && whole->header.isLast();
    const std::size_t count =
        isWhole ? std::min({parts, wire::dividableItems(whole->body), std::size_t{128}}) : 0;
    for (std::size_t part = 0; count > 1 && part < count; ++part) {
        auto bytes = wire::encode(partOf(*whole, part, count));
        if (!bytes) {
            all.clear();
            break;
        }
        all.push_back(std::move(*bytes));
    }
    if (all.empty()) {
        all.emplace_back(datagram.begin(), datagram.end());
    }
    return all;
}

} // namespace posewire::performer
