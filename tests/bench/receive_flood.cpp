// SPDX-License-Identifier: GPL-3.0-or-later
// 100,000 datagrams a second of 760 bytes for ten seconds, which may well be too many: each of them is in the
// log or in the log's count of those that this computer dropped. That is exact or the program fails, asked to
// check or not; nothing is timed.
//   receive_flood [--brief]
#include "app/net/receiver.h"
#include "tests/bench/udp_bench.h"

#include <QCoreApplication>

#include <atomic>
#include <cinttypes>
#include <cstring>
#include <thread>

namespace {

using namespace posewire;
using namespace posewire::bench;

constexpr double kRate = 100'000;

/// Follows the log and counts what it says.
class Count {
public:
    explicit Count(const log::PacketLog& log) : m_reader(log) {}

    void look() {
        m_reader.refresh();
        m_missed += m_reader.begin() > m_next ? m_reader.begin() - m_next : 0;
        m_next = std::max(m_next, m_reader.begin());
        for (; m_next < m_reader.end(); ++m_next) {
            const auto packet = m_reader.packet(m_next);
            m_missed += packet ? 0 : 1;
            m_received += packet && !packet->flags.isDropRecord ? 1 : 0;
            m_records += packet && packet->flags.isDropRecord ? 1 : 0;
            m_dropped += packet ? packet->kernelDropsBefore : 0;
        }
    }
    [[nodiscard]] std::uint64_t received() const { return m_received; }
    [[nodiscard]] std::uint64_t dropped() const { return m_dropped; }
    [[nodiscard]] std::uint64_t records() const { return m_records; }
    /// Gone before they could be counted: the count then proves nothing.
    [[nodiscard]] std::uint64_t missed() const { return m_missed; }

private:
    log::LogReader m_reader;
    std::uint64_t m_next = 0;
    std::uint64_t m_received = 0;
    std::uint64_t m_dropped = 0;
    std::uint64_t m_records = 0;
    std::uint64_t m_missed = 0;
};

int report(std::uint64_t sent, const Count& count, const net::ReceiveTotals& totals) {
    std::fprintf(stderr,
                 "sent %" PRIu64 ", in the log %" PRIu64 ", dropped says the log %" PRIu64 " (%" PRIu64
                 " records), dropped say the counters %" PRIu64 ", missed by this reader %" PRIu64
                 ", longest delay %.1f ms\n",
                 sent, count.received(), count.dropped(), count.records(), totals.kernelDropped,
                 count.missed(), log::millisecondsOf(totals.longestDelay));
    const auto unaccounted = static_cast<double>(sent) - static_cast<double>(count.received()) -
                             static_cast<double>(count.dropped());
    const bool isExact = unaccounted == 0 && count.missed() == 0 && totals.datagrams == count.received() &&
                         totals.kernelDropped == count.dropped();
    verdict("receive_flood_unaccounted", unaccounted, 0, false);
    return isExact ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    const QCoreApplication application(argc, argv);
    double duration = 10;
    for (int i = 1; i < argc; ++i) {
        duration = std::strcmp(argv[i], "--brief") == 0 ? 1 : duration;
    }
    log::PacketLog log;
    const log::SystemClock clock;
    net::Receiver receiver(log, clock);
    const auto id = receiver.addUdp(net::Endpoint{"127.0.0.1", 0});
    if (!id) {
        std::fprintf(stderr, "receive_flood: %s\n", id.error().text.c_str());
        return 2;
    }
    Count count(log);
    std::atomic<bool> isStopping = false;
    std::thread counting([&] {
        while (!isStopping) {
            count.look();
            std::this_thread::sleep_for(std::chrono::milliseconds(16));
        }
    });
    LoopbackSender sender(receiver.inputs().front().endpoint.port);
    sender.sendPaced(kRate, duration, 0.001);
    receiver.remove(*id); // what the socket still holds comes first, and what it dropped
    isStopping = true;
    counting.join();
    count.look();
    return report(sender.sent(), count, receiver.totals());
}
