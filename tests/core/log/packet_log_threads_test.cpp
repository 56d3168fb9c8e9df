// SPDX-License-Identifier: MIT
#include "core/log/packet_log.h"

#include "tests/core/log/log_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

namespace posewire::log {
namespace {

// Cheap to make and to check at full speed, yet every byte belongs to one packet only.
std::size_t sizeOf(std::uint64_t number) {
    return 24 + number * 37 % 1200;
}

std::byte fillOf(std::uint64_t number) {
    return static_cast<std::byte>(number * 151 & 0xff);
}

bool isIntact(const Packet& packet) {
    if (packet.bytes.size() != sizeOf(packet.number) || packet.stamp != Stamp(Duration(packet.number))) {
        return false;
    }
    for (const std::byte byte : packet.bytes) {
        if (byte != fillOf(packet.number)) {
            return false;
        }
    }
    return true;
}

struct ReaderResult {
    std::uint64_t intact = 0;
    std::uint64_t spoiled = 0;
    std::uint64_t missed = 0;
};

/// Follows the log to its end; every so often looks back at the oldest packet of its view.
ReaderResult readAll(const PacketLog& log, std::uint64_t total) {
    ReaderResult result;
    LogReader reader(log);
    for (std::uint64_t next = 0; next < total;) {
        if (!reader.refresh()) {
            std::this_thread::yield();
            continue;
        }
        if (const auto oldest = reader.packet(reader.begin()); oldest && !isIntact(*oldest)) {
            ++result.spoiled;
        }
        result.missed += reader.begin() > next ? reader.begin() - next : 0;
        for (next = std::max(next, reader.begin()); next < reader.end(); ++next) {
            const auto packet = reader.packet(next);
            if (!packet) {
                ++result
                      .missed; // dropped while this reader was busy: allowed, and must not be seen as spoiled
            } else {
                ++(isIntact(*packet) ? result.intact : result.spoiled);
            }
        }
    }
    return result;
}

void write(PacketLog& log, std::uint64_t total) {
    LogWriter& writer = log.writer();
    for (std::uint64_t number = 0; number < total;) {
        const auto lanes = writer.lanes();
        const std::size_t batch = std::min<std::size_t>(lanes.size(), total - number);
        for (std::size_t i = 0; i < batch; ++i) {
            std::memset(lanes[i].bytes.data(), std::to_integer<int>(fillOf(number + i)), sizeOf(number + i));
        }
        for (std::size_t i = 0; i < batch; ++i, ++number) {
            writer.commit(i, sizeOf(number), {.stamp = Stamp(Duration(number))});
        }
        writer.publish();
    }
}

TEST(PacketLogThreads, FourReadersSeeEveryPacketIntactWhileTheWriterTrims) {
    constexpr std::uint64_t kTotal = 300'000;
    PacketLog log({.memoryCap = std::size_t{2} << 20, .chunkSize = std::size_t{256} << 10});
    std::vector<ReaderResult> results(4);
    {
        std::vector<std::jthread> readers;
        for (ReaderResult& result : results) {
            readers.emplace_back([&] { result = readAll(log, kTotal); });
        }
        std::jthread writer([&] { write(log, kTotal); });
    }
    for (const ReaderResult& result : results) {
        EXPECT_EQ(result.spoiled, 0U);
        EXPECT_EQ(result.intact + result.missed, kTotal);
        EXPECT_GT(result.intact, 0U);
    }
    EXPECT_GT(log.figures().begin, 0U) << "the log must have been trimmed for this test to mean anything";
}

TEST(PacketLogThreads, NoReaderMissesAPacketWhereTheCapHasRoom) {
    constexpr std::uint64_t kTotal = 50'000;
    PacketLog log({.memoryCap = std::size_t{64} << 20, .chunkSize = std::size_t{256} << 10});
    std::vector<ReaderResult> results(4);
    {
        std::vector<std::jthread> readers;
        for (ReaderResult& result : results) {
            readers.emplace_back([&] { result = readAll(log, kTotal); });
        }
        std::jthread writer([&] { write(log, kTotal); });
    }
    for (const ReaderResult& result : results) {
        EXPECT_EQ(result.intact, kTotal);
    }
}

TEST(PacketLogThreads, SendersAreReadableWhileTheyAreInterned) {
    SenderTable table;
    constexpr std::uint32_t kTotal = 20'000;
    std::atomic<std::uint32_t> interned = 0;
    std::jthread writer([&] {
        for (std::uint32_t i = 0; i < kTotal; ++i) {
            table.intern({std::to_string(i), Transport::Udp, 9763});
            interned = i + 1;
        }
    });
    for (std::uint32_t seen = 0; seen < kTotal;) {
        seen = interned;
        const std::uint32_t newest = seen == 0 ? 0 : seen - 1;
        // Those that the writer's newest have pushed out meanwhile may be gone; a wrong one never comes.
        if (const auto held = table.find(static_cast<SenderId>(newest)); held && seen > 0) {
            ASSERT_EQ(held->address, std::to_string(newest));
        }
    }
}

} // namespace
} // namespace posewire::log
