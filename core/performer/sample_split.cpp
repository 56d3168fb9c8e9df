// SPDX-License-Identifier: MIT
#include "core/performer/sample_split.h"

#include "core/wire/type_table.h"

#include <algorithm>

namespace posewire::performer {
namespace {

/// The list of items of a body; null where it has none.
struct ItemsOf {
    auto* operator()(auto& body) const requires requires { body.segments; }
    { return &body.segments; }
    auto* operator()(auto& body) const requires requires { body.points; } &&(!requires { body.segments; }) {
        return &body.points;
    }
    auto* operator()(wire::JointAngles& body) const { return &body.joints; }
    auto* operator()(wire::TrackerKinematics& body) const { return &body.trackers; }
    std::vector<std::byte>* operator()(auto&) const { return nullptr; }
};

std::size_t itemsIn(wire::Body& body) {
    return std::visit(
        [](auto& value) {
            const auto* items = ItemsOf{}(value);
            return items == nullptr ? std::size_t{0} : items->size();
        },
        body);
}

/// Leaves the items from `from` to `to`.
void keep(wire::Body& body, std::size_t from, std::size_t to) {
    std::visit(
        [=](auto& value) {
            if (auto* items = ItemsOf{}(value)) {
                items->erase(items->begin() + static_cast<std::ptrdiff_t>(to), items->end());
                items->erase(items->begin(), items->begin() + static_cast<std::ptrdiff_t>(from));
            }
        },
        body);
}

wire::Datagram partOf(const wire::Datagram& whole, std::size_t part, std::size_t parts) {
    wire::Datagram datagram{whole.header, whole.body, {}};
    const std::size_t items = itemsIn(datagram.body);
    keep(datagram.body, part * items / parts, (part + 1) * items / parts);
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
    const std::size_t count = isWhole ? std::min({parts, itemsIn(whole->body), std::size_t{128}}) : 0;
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
