// SPDX-License-Identifier: MIT
#include "core/log/log_writer.h"

#include "tests/core/log/datagram_fixture.h"
#include "tests/core/log/log_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace posewire::log {
namespace {

/// Does what the kernel does with a message of two parts: fills the first, continues in the second.
void writeInto(const LogWriter::Lane& lane, std::span<const std::byte> bytes) {
    const std::size_t head = std::min(bytes.size(), lane.bytes.size());
    std::copy_n(bytes.begin(), head, lane.bytes.begin());
    std::copy(bytes.begin() + static_cast<std::ptrdiff_t>(head), bytes.end(), lane.spill.begin());
}

/// Receives packets `first` … `first + sizes.size()` in batches as large as the lanes allow.
void receive(PacketLog& log, std::uint64_t first, std::span<const std::size_t> sizes) {
    for (std::size_t done = 0; done < sizes.size();) {
        const auto lanes = log.writer().lanes();
        const std::size_t batch = std::min(lanes.size(), sizes.size() - done);
        for (std::size_t i = 0; i < batch; ++i) {
            writeInto(lanes[i], pattern(sizes[done + i], first + done + i));
        }
        for (std::size_t i = 0; i < batch; ++i) {
            log.writer().commit(i, sizes[done + i], {.stamp = Stamp(Duration(first + done + i))});
        }
        log.writer().publish();
        done += batch;
    }
}

void expectPatterns(PacketLog& log, std::span<const std::size_t> sizes) {
    LogReader reader(log);
    ASSERT_EQ(reader.end(), sizes.size());
    for (std::uint64_t i = reader.begin(); i < reader.end(); ++i) {
        const auto packet = reader.packet(i);
        ASSERT_TRUE(packet);
        ASSERT_EQ(packet->stamp, Stamp(Duration(i)));
        ASSERT_TRUE(equal(packet->bytes, pattern(sizes[i], i)))
            << "packet " << i << " of " << sizes[i] << " bytes";
    }
}

TEST(LogWriter, EveryLaneTakesTheLargestLegalDatagramAndItsSpillAnyOther) {
    PacketLog log(kSmallLog);
    for (std::size_t round = 0; round < 20; ++round) {
        const auto lanes = log.writer().lanes();
        ASSERT_GE(lanes.size(), 1U);
        ASSERT_LE(lanes.size(), LogWriter::kLaneLimit);
        for (const LogWriter::Lane& lane : lanes) {
            EXPECT_GE(lane.bytes.size(), LogWriter::kLaneRoom);
            EXPECT_GE(lane.spill.size(), LogWriter::kSpillSize);
        }
        log.writer().commit(0, 2168, {});
    }
}

TEST(LogWriter, KeepsTheDatagramsOfOnePacketApart) {
    for (const wire::HeaderEra era : {wire::HeaderEra::Counted, wire::HeaderEra::Reserved}) {
        for (const std::size_t count : {1U, 2U, 40U}) {
            SCOPED_TRACE(count);
            ByteVector joined;
            for (std::uint32_t sample = 1; sample <= count; ++sample) {
                const ByteVector one = poseDatagram(sample, 23, era);
                joined.insert(joined.end(), one.begin(), one.end());
            }
            PacketLog log(kSmallLog);
            writeInto(log.writer().lanes()[0], joined);
            log.writer().commit(0, joined.size(), {.kernelDropsBefore = 3});
            log.writer().append(joined, {});
            log.writer().publish();
            LogReader reader(log);
            ASSERT_EQ(reader.end(), 2 * count);
            for (std::size_t number = 0; number < 2 * count; ++number) {
                const auto packet = reader.packet(number);
                EXPECT_TRUE(equal(packet->bytes,
                                  poseDatagram(static_cast<std::uint32_t>(number % count) + 1, 23, era)));
                EXPECT_EQ(packet->flags.shared, count == 1 ? 0U : std::min<std::size_t>(count, 7));
                EXPECT_EQ(packet->kernelDropsBefore, number == 0 ? 3U : 0U);
            }
        }
    }
}

TEST(LogWriter, KeepsAPacketWholeIfNoDatagramFollowsInIt) {
    PacketLog log(kSmallLog);
    ByteVector trailing = poseDatagram(1);
    trailing.insert(trailing.end(), 30, std::byte{'M'});
    log.writer().append(trailing, {});
    log.writer().publish();
    EXPECT_EQ(LogReader(log).end(), 1U);
}

TEST(LogWriter, LanesNeverOverlap) {
    PacketLog log(kSmallLog);
    for (std::size_t round = 0; round < 200; ++round) {
        const auto lanes = log.writer().lanes();
        std::vector<std::pair<const std::byte*, const std::byte*>> ranges;
        for (const LogWriter::Lane& lane : lanes) {
            ranges.emplace_back(lane.bytes.data(), lane.bytes.data() + lane.bytes.size());
        }
        std::ranges::sort(ranges);
        for (std::size_t i = 1; i < ranges.size(); ++i) {
            ASSERT_LE(ranges[i - 1].second, ranges[i].first) << "round " << round;
        }
        for (std::size_t i = 0; i < lanes.size(); i += 2) {
            log.writer().commit(i, 700 + 13 * i, {});
        }
    }
}

TEST(LogWriter, CommittedPacketsAreIntactWhateverTheirSizes) {
    std::mt19937 random(7);
    std::vector<std::size_t> sizes;
    for (std::size_t i = 0; i < 20'000; ++i) {
        const auto kind = random() % 100;
        sizes.push_back(kind < 60   ? 760
                        : kind < 80 ? random() % 2304
                        : kind < 99 ? random() % 60
                                    : random() % 65'508);
    }
    PacketLog log(kSmallLog);
    receive(log, 0, sizes);
    expectPatterns(log, sizes);
    EXPECT_LE(log.figures().memoryAllocated, kSmallLog.memoryCap + kSmallLog.chunkSize);
}

TEST(LogWriter, OversizedDatagramsPassThroughTheSpillEvenAllAtOnce) {
    const std::vector<std::size_t> sizes(100, 65'507);
    PacketLog log({.memoryCap = std::size_t{16} << 20, .chunkSize = std::size_t{256} << 10});
    receive(log, 0, sizes);
    expectPatterns(log, sizes);
}

TEST(LogWriter, BoundarySizesOfLaneAndSpill) {
    PacketLog log({.memoryCap = std::size_t{16} << 20, .chunkSize = std::size_t{1} << 20});
    std::vector<std::size_t> sizes;
    for (const std::size_t size : {0, 1, 7, 8, 9, 2303, 2304, 2305, 4095, 4096, 4097, 65'507, 65'536}) {
        sizes.insert(sizes.end(), 40, size);
    }
    receive(log, 0, sizes);
    expectPatterns(log, sizes);
}

TEST(LogWriter, LanesAndAppendTakeTurns) {
    PacketLog log(kSmallLog);
    std::vector<std::size_t> sizes;
    for (std::size_t i = 0; i < 3000; ++i) {
        if (i % 3 == 0) {
            log.writer().append(pattern(900, sizes.size()), {.stamp = Stamp(Duration(sizes.size()))});
            log.writer().publish();
            sizes.push_back(900);
        } else {
            const std::vector<std::size_t> batch(i % 7, 500);
            receive(log, sizes.size(), batch);
            sizes.insert(sizes.end(), batch.begin(), batch.end());
        }
    }
    expectPatterns(log, sizes);
}

TEST(LogWriter, LanesPackTightly) {
    PacketLog log({.memoryCap = std::size_t{64} << 20, .chunkSize = std::size_t{8} << 20});
    const std::vector<std::size_t> sizes(50'000, 760);
    receive(log, 0, sizes);
    LogReader reader(log);
    const double used = 50'000.0 * 760;
    EXPECT_LT(static_cast<double>(log.figures().memoryInUse - (std::size_t{8} << 20)), used * 1.2);
}

} // namespace
} // namespace posewire::log
