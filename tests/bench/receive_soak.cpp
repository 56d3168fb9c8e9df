// SPDX-License-Identifier: GPL-3.0-or-later
// 10,000 datagrams a second for a minute, while a reader of the log is blocked for a second in the middle:
// none may be lost in this computer.
//   receive_soak [--check] [--brief]
#include "app/net/receiver.h"
#include "tests/bench/udp_bench.h"

#include <QCoreApplication>

#include <atomic>
#include <cstring>
#include <thread>

namespace {

using namespace posewire;
using namespace posewire::bench;

constexpr double kRate = 10'000;

/// Follows the log as the window does, about 60 times a second; counts what it sees and what is missing
/// between.
class Reader {
public:
    explicit Reader(const log::PacketLog& log) : m_reader(log) {}

    void look() {
        m_reader.refresh();
        for (; m_next < m_reader.end(); ++m_next) {
            const auto packet = m_reader.packet(m_next);
            std::uint64_t number = 0;
            if (packet && packet->bytes.size() == kDatagramSize) {
                std::memcpy(&number, packet->bytes.data(), sizeof number);
                m_seen += number == m_expected ? 1 : 0;
                m_expected = number + 1;
            }
        }
    }
    [[nodiscard]] std::uint64_t seenInOrder() const { return m_seen; }

private:
    log::LogReader m_reader;
    std::uint64_t m_next = 0;
    std::uint64_t m_expected = 0;
    std::uint64_t m_seen = 0;
};

struct Result {
    std::uint64_t sent = 0;
    std::uint64_t received = 0;
    std::uint64_t seenInOrder = 0;
};

Result soak(net::Receiver& receiver, const log::PacketLog& log, double duration) {
    Result result;
    std::atomic<bool> isStopping = false;
    std::thread reading([&] {
        Reader reader(log);
        const double start = seconds(CLOCK_MONOTONIC);
        bool wasBlocked = false;
        while (!isStopping) {
            reader.look();
            const bool isMiddle = seconds(CLOCK_MONOTONIC) - start > duration / 2;
            std::this_thread::sleep_for(std::chrono::milliseconds(isMiddle && !wasBlocked ? 1000 : 16));
            wasBlocked |= isMiddle;
        }
        reader.look();
        result.seenInOrder = reader.seenInOrder();
    });
    LoopbackSender sender(receiver.inputs().front().endpoint.port);
    sender.sendPaced(kRate, duration, 0.001);
    result.sent = sender.sent();
    for (int i = 0; i < 1000 && receiver.totals().datagrams < result.sent; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    isStopping = true;
    reading.join();
    result.received = receiver.totals().datagrams;
    return result;
}

} // namespace

int main(int argc, char** argv) {
    const QCoreApplication application(argc, argv);
    double duration = 60;
    bool isChecked = false;
    for (int i = 1; i < argc; ++i) {
        isChecked |= std::strcmp(argv[i], "--check") == 0;
        duration = std::strcmp(argv[i], "--brief") == 0 ? 2 : duration;
    }
    log::PacketLog log;
    const log::SystemClock clock;
    net::Receiver receiver(log, clock);
    if (const auto id = receiver.addUdp(net::Endpoint{"127.0.0.1", 0}); !id) {
        std::fprintf(stderr, "receive_soak: %s\n", id.error().text.c_str());
        return 2;
    }
    const Result result = soak(receiver, log, duration);
    const net::ReceiveTotals totals = receiver.totals();
    std::fprintf(stderr,
                 "sent %llu, received %llu, seen in order by the reader %llu, dropped by the kernel %llu, "
                 "longest delay "
                 "%.1f ms, receive buffer %lld bytes\n",
                 static_cast<unsigned long long>(result.sent),
                 static_cast<unsigned long long>(result.received),
                 static_cast<unsigned long long>(result.seenInOrder),
                 static_cast<unsigned long long>(totals.kernelDropped),
                 log::millisecondsOf(totals.longestDelay), static_cast<long long>(totals.receiveBufferBytes));
    return verdict("receive_soak_lost", static_cast<double>(result.sent - result.seenInOrder), 0, isChecked);
}
