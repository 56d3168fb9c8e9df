// SPDX-License-Identifier: GPL-3.0-or-later
// What a datagram costs from the wake-up of the receiving thread to updated statistics, at 100,000 poses a
// second, against a recvmmsg loop that does nothing with them: the CPU time of the receiving thread and of
// the thread whose session follows the log as the window does.
//   statistics_bench [--check] [--brief]
// Both are measured in turn, so that a slow spell of the computer hits both; the ratio of the medians counts.
#include "app/net/receiver.h"
#include "core/model/session/session.h"
#include "tests/bench/udp_bench.h"

#include <QCoreApplication>

#include <poll.h>

#include <atomic>
#include <cinttypes>
#include <cstring>
#include <thread>

namespace {

using namespace posewire;
using namespace posewire::bench;

constexpr double kLimit = 2.5;
constexpr double kRate = 100'000;
constexpr double kBurstS = 0.001;
constexpr log::Duration kFollow = std::chrono::milliseconds(16);

std::array<std::byte, kDatagramSize> poseBytes() {
    wire::PoseQuaternion pose;
    for (std::uint32_t segment = 1; segment <= 23; ++segment) {
        pose.segments.push_back({segment, {0.1F, 0.2F, 1.0F}, {1, 0, 0, 0}});
    }
    wire::Datagram datagram;
    datagram.body = pose;
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    const wire::Bytes bytes = wire::encode(datagram).value();
    std::array<std::byte, kDatagramSize> all{};
    std::ranges::copy(bytes, all.begin());
    return all;
}

/// Sample counter and time code of a sender at that rate.
void numberPose(std::span<std::byte, kDatagramSize> bytes, std::uint64_t number) {
    const auto put = [&bytes](std::size_t offset, std::uint32_t value) {
        for (std::size_t i = 0; i < 4; ++i) {
            bytes[offset + i] = static_cast<std::byte>(value >> (24 - 8 * i));
        }
    };
    put(6, static_cast<std::uint32_t>(number));
    put(12, static_cast<std::uint32_t>(static_cast<double>(number) * 1000 / kRate));
}

struct Cost {
    double nanoseconds = 0; ///< of CPU, a datagram
    std::uint64_t sent = 0;
    std::uint64_t received = 0;
};

Cost bare(double duration) {
    const PlainSocket socket;
    std::atomic<bool> isStopping = false;
    Cost cost;
    std::thread receiver([&] {
        stayOn(true);
        BareLoop loop(false);
        const double begin = threadCpuSeconds();
        while (!isStopping) {
            pollfd watched{socket.descriptor(), POLLIN, 0};
            ::poll(&watched, 1, 50);
            cost.received += loop.drain(socket.descriptor());
        }
        cost.nanoseconds = (threadCpuSeconds() - begin) * 1e9;
    });
    LoopbackSender sender(socket.port(), poseBytes(), numberPose);
    sender.sendPaced(kRate, duration, kBurstS);
    isStopping = true;
    receiver.join();
    cost.nanoseconds /= static_cast<double>(std::max<std::uint64_t>(1, cost.received));
    cost.sent = sender.sent();
    return cost;
}

Cost ours(double duration) {
    log::PacketLog log;
    const log::SystemClock clock;
    stayOn(true); // the receiving thread inherits it
    net::Receiver receiver(log, clock);
    const auto id = receiver.addUdp(net::Endpoint{"127.0.0.1", 0});
    if (!id) {
        std::fprintf(stderr, "statistics_bench: %s\n", id.error().text.c_str());
        std::exit(2);
    }
    stayOn(false);
    std::atomic<bool> isStopping = false;
    double following = 0;
    model::Session session(log);
    std::thread follower([&] {
        stayOn(true);
        const double begin = threadCpuSeconds();
        while (!isStopping) {
            session.follow(log.timeline().now(clock));
            std::this_thread::sleep_for(kFollow);
        }
        session.follow(log.timeline().now(clock));
        following = threadCpuSeconds() - begin;
    });
    LoopbackSender sender(receiver.inputs().front().endpoint.port, poseBytes(), numberPose);
    const double before = receiver.cpuSeconds().value_or(0);
    sender.sendPaced(kRate, duration, kBurstS);
    const double receiving = receiver.cpuSeconds().value_or(0) - before;
    receiver.remove(*id);
    isStopping = true;
    follower.join();
    const std::uint64_t received = receiver.totals().datagrams;
    return {(receiving + following) * 1e9 / static_cast<double>(std::max<std::uint64_t>(1, received)),
            sender.sent(), received};
}

} // namespace

int main(int argc, char** argv) {
    const QCoreApplication application(argc, argv);
    stayOn(false);
    int runs = 5;
    double duration = 2;
    bool isChecked = false;
    for (int i = 1; i < argc; ++i) {
        isChecked |= std::strcmp(argv[i], "--check") == 0;
        if (std::strcmp(argv[i], "--brief") == 0) {
            runs = 1;
            duration = 0.2;
        }
    }
    std::vector<double> floors;
    std::vector<double> costs;
    for (int i = 0; i < runs; ++i) {
        const Cost floor = bare(duration);
        const Cost cost = ours(duration);
        floors.push_back(floor.nanoseconds);
        costs.push_back(cost.nanoseconds);
        std::fprintf(stderr,
                     "bare %.0f ns (%" PRIu64 " of %" PRIu64 "), ours %.0f ns a datagram (%" PRIu64
                     " of %" PRIu64 ")\n",
                     floor.nanoseconds, floor.received, floor.sent, cost.nanoseconds, cost.received,
                     cost.sent);
    }
    return verdict("statistics_100000", median(costs) / median(floors), kLimit, isChecked);
}
