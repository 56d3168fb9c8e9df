// SPDX-License-Identifier: MIT
#include "core/filter/filter.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <vector>

// What does it cost to filter a million packets (decode where the filter needs it, digest, match), against
// copying their bytes? Poses of 23 segments, 760 bytes each.
//   filter_bench [--brief] [--check]
namespace {

using namespace posewire;

constexpr double kLimitSeconds = 2.0; // for a million packets
constexpr std::size_t kMillion = 1'000'000;
constexpr std::size_t kKept = 4096; // different ones: their bytes do not stay in the first cache

std::vector<std::vector<std::byte>> datagrams() {
    std::vector<std::vector<std::byte>> all;
    for (std::uint32_t n = 0; n < kKept; ++n) {
        wire::PoseQuaternion pose;
        for (std::uint32_t id = 1; id <= 23; ++id) {
            const float height = n % 16 == 0 && id == 23 ? 2.5F : static_cast<float>(id) * 0.05F;
            pose.segments.push_back({id, {static_cast<float>(n) * 0.001F, 0.0F, height}, {1, 0, 0, 0}});
        }
        wire::Datagram datagram;
        datagram.header.sampleCounter = n % 64 < 60 ? n : n + 8; // a few gaps
        datagram.header.character = static_cast<std::uint8_t>(n % 2);
        datagram.header.bodySegments = 23;
        datagram.body = std::move(pose);
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        all.push_back(*wire::encode(datagram));
    }
    return all;
}

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Seconds that all packets take, and how many matched.
std::pair<double, std::size_t> filtered(std::string_view text, const std::vector<std::vector<std::byte>>& all,
                                        std::size_t packets) {
    const auto filter = filter::Filter::compile(text);
    const auto start = std::chrono::steady_clock::now();
    model::PacketDigester digester;
    wire::Datagram datagram;
    std::size_t matched = 0;
    for (std::size_t i = 0; i < packets; ++i) {
        log::Packet packet;
        packet.number = i;
        packet.stamp = log::Stamp(std::chrono::microseconds(i));
        packet.bytes = all[i % all.size()];
        const bool isDecoded = wire::decodeInto(packet.bytes, datagram).has_value();
        const model::PacketDigest digest = digester.add(packet, isDecoded ? &datagram : nullptr);
        matched += filter->matches({packet, digest, isDecoded ? &datagram : nullptr}) ? 1 : 0;
    }
    return {secondsSince(start), matched};
}

double copied(const std::vector<std::vector<std::byte>>& all, std::size_t packets) {
    std::vector<std::byte> into(1024);
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < packets; ++i) {
        const auto& bytes = all[i % all.size()];
        std::memcpy(into.data(), bytes.data(), bytes.size());
        asm volatile("" : : "r"(into.data()) : "memory");
    }
    return secondsSince(start);
}

} // namespace

int main(int argumentCount, char** arguments) {
    const std::vector<std::string_view> options(arguments + 1, arguments + argumentCount);
    const auto isGiven = [&](std::string_view name) {
        return std::find(options.begin(), options.end(), name) != options.end();
    };
    const std::size_t packets = isGiven("--brief") ? kMillion / 50 : kMillion;
    const double toMillion = static_cast<double>(kMillion) / static_cast<double>(packets);
    const auto all = datagrams();
    const double copying = copied(all, packets) * toMillion;
    bool isRight = true;
    for (const std::string_view text : {"type == 02 && character == 1 && gap > 0", "position.z > 2"}) {
        const auto [seconds, matched] = filtered(text, all, packets);
        const double perMillion = seconds * toMillion;
        isRight = isRight && matched > 0 && (!isGiven("--check") || perMillion <= kLimitSeconds);
        std::printf("# %s: %zu of %zu packets match; %.0f times copying the bytes (%.3f s)\n",
                    std::string(text).c_str(), matched, packets, perMillion / copying, copying);
        std::printf("filter_seconds %.2f %.1f\n", perMillion, kLimitSeconds);
    }
    return isRight ? 0 : 1;
}
