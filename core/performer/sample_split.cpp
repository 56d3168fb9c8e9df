// SPDX-License-Identifier: MIT
#include "core/performer/sample_split.h"

#include "core/wire/message_parts.h"
#include "core/wire/type_table.h"

#include <algorithm>

namespace posewire::performer {
namespace {

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
