// SPDX-License-Identifier: MIT
#pragma once

#include "core/filter/filter.h"
#include "tests/support/golden.h"

#include <gtest/gtest.h>

#include <memory>

namespace posewire::filter::test {

using namespace std::chrono_literals;

/// A packet with everything that a filter may look at.
struct Case {
    explicit Case(std::vector<std::byte> from) : bytes(std::move(from)) {
        packet.bytes = bytes;
        packet.number = 41;
        packet.stamp = log::Stamp(1'800'000'000s + 500ms);
        auto decoded = wire::decode(bytes);
        if (decoded) {
            datagram = std::move(*decoded);
        } else {
            fault = decoded.error();
        }
        digest = model::PacketDigester().add(packet, fault ? nullptr : &datagram);
    }
    explicit Case(const wire::Datagram& from) : Case(*wire::encode(from)) {}

    [[nodiscard]] Candidate candidate() const {
        return {packet, digest, fault ? nullptr : &datagram, &sender, packet.stamp - 2'500ms, nullptr};
    }

    std::vector<std::byte> bytes;
    log::Packet packet;
    wire::Datagram datagram;
    std::optional<wire::WireError> fault;
    model::PacketDigest digest;
    log::SenderInfo sender{"192.168.1.20:4001", log::Transport::Udp, 9763};
};

inline Case golden(const std::string& name) {
    return Case(posewire::test::golden(name).bytes);
}

inline bool matches(const Case& packet, std::string_view text) {
    const auto filter = Filter::compile(text);
    if (!filter) {
        ADD_FAILURE() << text << ": " << filter.error().offset << ": " << filter.error().text;
        return false;
    }
    return filter->matches(packet.candidate());
}

/// A pose of one segment per position, ids from 1.
inline Case pose(const std::vector<wire::Vec3>& positions) {
    wire::PoseQuaternion body;
    for (const wire::Vec3& position : positions) {
        body.segments.push_back(
            {static_cast<std::uint32_t>(body.segments.size() + 1), position, {1, 0, 0, 0}});
    }
    wire::Datagram datagram;
    datagram.body = std::move(body);
    wire::completeHeader(datagram, wire::HeaderEra::Reserved);
    return Case(datagram);
}

} // namespace posewire::filter::test
