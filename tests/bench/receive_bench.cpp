// SPDX-License-Identifier: GPL-3.0-or-later
// What receiving, stamping and keeping a datagram costs, against a recvmmsg loop that does nothing with the
// bytes.
//   receive_bench [--check] [--brief]
// All are measured in turn, so that a slow spell of the computer hits all; the ratio of the medians counts.
// drain: a backlog is read. The yardstick asks the kernel for sender and stamp, as any receiver of datagrams
// must, which
//        alone costs a quarter more than a loop that does not even want to know; that one is shown beside it.
// live:  24,000 datagrams a second from another thread. The yardstick is poll and recvmmsg without sender and
// stamp.
#include "app/net/receive_loop.h"
#include "tests/bench/udp_bench.h"

#include <QCoreApplication>

#include <poll.h>

#include <atomic>
#include <cstring>
#include <thread>

namespace {

using namespace posewire;
using namespace posewire::bench;

constexpr double kLimit = 1.3;
constexpr std::size_t kBacklog = 1200; ///< fits into the socket's buffer

struct Plan {
    int drainRuns = 15;
    int drainRounds = 60;
    int liveRuns = 25;
    double liveSeconds = 0.5;
    std::size_t memoryCap = std::size_t{512} << 20;
};

/// Everything a receive loop needs, with a log that lives from round to round.
struct Bench {
    /// With a log that is full, as it is after half a minute and from then on.
    explicit Bench(std::size_t memoryCap) : log({.memoryCap = memoryCap}) {
        const std::vector<std::byte> bytes(kDatagramSize);
        while (log.figures().begin == 0) {
            log.writer().append(bytes, {});
            log.writer().publish();
        }
    }

    log::PacketLog log;
    log::SystemClock clock;
    net::PacketQueue queue;
    net::CommandQueue commands;
    net::ReceiveCounters counters;
    std::atomic<log::Duration> nap = net::ReceiverOptions().nap;
    std::shared_ptr<net::Input> input; ///< of the loop opened last

    std::unique_ptr<net::ReceiveLoop> open(std::uint16_t& port) {
        auto loop = net::makeReceiveLoop({log, clock, queue, commands, counters, nap, {}});
        input =
            std::make_shared<net::Input>(net::InputId{}, net::InputKind::Udp, net::Endpoint{"127.0.0.1", 0});
        if (const auto added = loop->add(input); !added) {
            std::fprintf(stderr, "receive_bench: %s\n", added.error().text.c_str());
            std::exit(2);
        }
        port = input->status().endpoint.port;
        return loop;
    }
    [[nodiscard]] std::uint64_t received() const { return input->counters().datagrams; }
};

/// CPU nanoseconds a datagram, with a backlog laid into the socket first.
double drainBare(int rounds, bool hasSenderAndStamp) {
    BareLoop loop(hasSenderAndStamp);
    double cpu = 0;
    std::size_t received = 0;
    for (int i = 0; i < rounds; ++i) {
        const PlainSocket socket;
        const int isStamped = hasSenderAndStamp ? 1 : 0;
        ::setsockopt(socket.descriptor(), SOL_SOCKET, SO_TIMESTAMPNS, &isStamped, sizeof isStamped);
        LoopbackSender(socket.port()).send(kBacklog);
        const double begin = threadCpuSeconds();
        received += loop.drain(socket.descriptor());
        cpu += threadCpuSeconds() - begin;
    }
    return cpu * 1e9 / static_cast<double>(received);
}

double drainOurs(Bench& bench, int rounds) {
    double cpu = 0;
    std::uint64_t received = 0;
    for (int i = 0; i < rounds; ++i) {
        std::uint16_t port = 0;
        const auto loop = bench.open(port);
        LoopbackSender(port).send(kBacklog);
        loop->stop(); // it then takes what is there, once
        const double begin = threadCpuSeconds();
        loop->run();
        cpu += threadCpuSeconds() - begin;
        received += bench.received();
    }
    return cpu * 1e9 / static_cast<double>(received);
}

/// CPU nanoseconds a datagram of a thread that receives 24,000 a second in bursts each millisecond.
double liveBare(double duration) {
    const PlainSocket socket;
    std::atomic<bool> isStopping = false;
    double nanoseconds = 0;
    std::thread receiver([&] {
        stayOn(true);
        BareLoop loop(false);
        std::size_t received = 0;
        const double begin = threadCpuSeconds();
        while (!isStopping) {
            pollfd watched{socket.descriptor(), POLLIN, 0};
            ::poll(&watched, 1, 50);
            received += loop.drain(socket.descriptor());
        }
        nanoseconds =
            (threadCpuSeconds() - begin) * 1e9 / static_cast<double>(std::max<std::size_t>(1, received));
    });
    LoopbackSender(socket.port()).sendPaced(24'000, duration, 0.001);
    isStopping = true;
    receiver.join();
    return nanoseconds;
}

double liveOurs(Bench& bench, double duration) {
    std::atomic<net::ReceiveLoop*> running = nullptr;
    std::atomic<std::uint16_t> portOfLoop = 0;
    double nanoseconds = 0;
    std::thread receiver([&] {
        stayOn(true);
        std::uint16_t port = 0;
        const auto loop = bench.open(port);
        portOfLoop = port;
        running = loop.get();
        running.notify_one();
        const double begin = threadCpuSeconds();
        loop->run();
        const auto received = static_cast<double>(bench.received());
        nanoseconds = (threadCpuSeconds() - begin) * 1e9 / std::max(1.0, received);
    });
    running.wait(nullptr);
    LoopbackSender(portOfLoop).sendPaced(24'000, duration, 0.001);
    running.load()->stop();
    receiver.join();
    return nanoseconds;
}

int drain(const Plan& plan, bool isChecked) {
    Bench bench(plan.memoryCap);
    std::vector<double> plain;
    std::vector<double> bare;
    std::vector<double> ours;
    for (int i = 0; i < plan.drainRuns; ++i) {
        plain.push_back(drainBare(plan.drainRounds, false));
        bare.push_back(drainBare(plan.drainRounds, true));
        ours.push_back(drainOurs(bench, plan.drainRounds));
        std::fprintf(stderr,
                     "drain: bare %.0f ns, bare with sender and stamp %.0f ns, ours %.0f ns a datagram\n",
                     plain.back(), bare.back(), ours.back());
    }
    return verdict("receive_drain", median(ours) / median(bare), kLimit, isChecked);
}

int live(const Plan& plan, bool isChecked) {
    Bench bench(plan.memoryCap);
    std::vector<double> bare;
    std::vector<double> ours;
    for (int i = 0; i < plan.liveRuns; ++i) {
        bare.push_back(liveBare(plan.liveSeconds));
        ours.push_back(liveOurs(bench, plan.liveSeconds));
        std::fprintf(stderr, "live: bare %.0f ns, ours %.0f ns a datagram\n", bare.back(), ours.back());
    }
    return verdict("receive_live_24000", median(ours) / median(bare), kLimit, isChecked);
}

} // namespace

int main(int argc, char** argv) {
    const QCoreApplication application(argc, argv);
    stayOn(false);
    Plan plan;
    bool isChecked = false;
    for (int i = 1; i < argc; ++i) {
        isChecked |= std::strcmp(argv[i], "--check") == 0;
        if (std::strcmp(argv[i], "--brief") == 0) {
            plan = {.drainRuns = 1,
                    .drainRounds = 3,
                    .liveRuns = 1,
                    .liveSeconds = 0.2,
                    .memoryCap = std::size_t{32} << 20};
        }
    }
    const int drained = drain(plan, isChecked);
    const int lived = live(plan, isChecked);
    return std::max(drained, lived);
}
