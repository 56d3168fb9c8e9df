// SPDX-License-Identifier: MIT
#include "core/log/packet_log.h"

#include "tests/core/log/log_fixture.h"

#include <gtest/gtest.h>

namespace posewire::log {
namespace {

using namespace std::chrono_literals;

void appendPattern(PacketLog& log, std::uint64_t seed, std::size_t size) {
    log.writer().append(pattern(size, seed), {.stamp = Stamp(Duration(seed))});
}

TEST(PacketLog, IsEmptyAtFirst) {
    PacketLog log;
    LogReader reader(log);
    EXPECT_EQ(reader.begin(), 0U);
    EXPECT_EQ(reader.end(), 0U);
    EXPECT_FALSE(reader.refresh());
    EXPECT_FALSE(reader.packet(0).has_value());
    EXPECT_EQ(log.figures().memoryInUse, 0U);
}

TEST(PacketLog, GivesBackWhatWasAppended) {
    PacketLog log;
    const SenderId sender = log.senders().intern({"127.0.0.1:40001", Transport::Tcp, 9763});
    const auto bytes = pattern(760, 1);
    log.writer().append(bytes, {.stamp = Stamp(42ns),
                                .sender = sender,
                                .kernelDropsBefore = 7,
                                .flags = {.truncated = true, .stampedByKernel = true, .skipped = true}});
    log.writer().publish();

    LogReader reader(log);
    const auto packet = reader.packet(0);
    ASSERT_TRUE(packet);
    EXPECT_EQ(packet->number, 0U);
    EXPECT_EQ(packet->stamp, Stamp(42ns));
    EXPECT_EQ(packet->sender, sender);
    EXPECT_EQ(packet->kernelDropsBefore, 7U);
    EXPECT_EQ(packet->flags, (PacketFlags{true, true, true}));
    EXPECT_TRUE(equal(packet->bytes, bytes));
}

TEST(PacketLog, ShowsOnlyWhatIsPublishedAndOnlyOnRefresh) {
    PacketLog log;
    LogReader reader(log);
    appendPattern(log, 0, 100);
    EXPECT_FALSE(reader.refresh());
    log.writer().publish();
    EXPECT_EQ(reader.end(), 0U);
    EXPECT_FALSE(reader.packet(0).has_value());
    EXPECT_TRUE(reader.refresh());
    EXPECT_EQ(reader.end(), 1U);
    EXPECT_TRUE(reader.packet(0).has_value());
    EXPECT_FALSE(reader.packet(1).has_value());
    EXPECT_FALSE(reader.refresh());
}

TEST(PacketLog, KeepsEveryPacketAcrossChunks) {
    PacketLog log({.memoryCap = std::size_t{8} << 20, .chunkSize = std::size_t{256} << 10});
    constexpr std::uint64_t kCount = 5000;
    for (std::uint64_t i = 0; i < kCount; ++i) {
        appendPattern(log, i, i % 1500);
    }
    log.writer().publish();
    LogReader reader(log);
    ASSERT_EQ(reader.begin(), 0U);
    ASSERT_EQ(reader.end(), kCount);
    for (std::uint64_t i = kCount; i-- > 0;) {
        const auto packet = reader.packet(i);
        ASSERT_TRUE(packet);
        ASSERT_EQ(packet->number, i);
        ASSERT_EQ(packet->stamp, Stamp(Duration(i)));
        ASSERT_TRUE(equal(packet->bytes, pattern(i % 1500, i))) << i;
    }
}

TEST(PacketLog, DropsTheOldestAtTheCapAndNeverExceedsIt) {
    PacketLog log(kSmallLog);
    for (std::uint64_t i = 0; i < 20'000; ++i) {
        appendPattern(log, i, 700);
        ASSERT_LE(log.figures().memoryAllocated, kSmallLog.memoryCap);
    }
    log.writer().publish();
    LogReader reader(log);
    EXPECT_GT(reader.begin(), 0U);
    EXPECT_EQ(reader.end(), 20'000U);
    EXPECT_GT((reader.end() - reader.begin()) * 700, kSmallLog.memoryCap / 2);
    EXPECT_FALSE(reader.packet(reader.begin() - 1).has_value());
    for (std::uint64_t i = reader.begin(); i < reader.end(); ++i) {
        const auto packet = reader.packet(i);
        ASSERT_TRUE(packet);
        ASSERT_TRUE(equal(packet->bytes, pattern(700, i))) << i;
    }
    const LogFigures figures = log.figures();
    EXPECT_EQ(figures.begin, reader.begin());
    EXPECT_EQ(figures.end, 20'000U);
    EXPECT_EQ(figures.memoryInUse, figures.chunkBytes + (figures.end - figures.begin) * kBesidePacket);
    EXPECT_LE(figures.memoryInUse, kSmallLog.memoryCap);
    EXPECT_GT(figures.memoryInUse, kSmallLog.memoryCap - kSmallLog.chunkSize);
    EXPECT_EQ(figures.memoryCap, kSmallLog.memoryCap);
}

TEST(PacketLog, UsesDroppedChunksAgain) {
    PacketLog log(kSmallLog);
    for (std::uint64_t i = 0; i < 100'000; ++i) {
        appendPattern(log, i, 700);
    }
    log.writer().publish();
    EXPECT_EQ(log.figures().memoryAllocated, log.figures().memoryInUse) << "none is spare";
}

TEST(PacketLog, ReaderKeepsWhatItLooksAtWhileTheLogDropsIt) {
    PacketLog log(kSmallLog);
    appendPattern(log, 0, 760);
    log.writer().publish();
    LogReader reader(log);
    const auto packet = reader.packet(0);
    ASSERT_TRUE(packet);
    for (std::uint64_t i = 1; i < 20'000; ++i) {
        appendPattern(log, i, 760);
    }
    log.writer().publish();
    EXPECT_GT(log.figures().begin, 0U);
    EXPECT_GT(log.figures().memoryAllocated, log.figures().memoryInUse);
    EXPECT_TRUE(equal(packet->bytes, pattern(760, 0)));
    EXPECT_TRUE(reader.packet(0).has_value()) << "still held";

    reader.refresh();
    EXPECT_FALSE(reader.packet(0).has_value());
    EXPECT_EQ(reader.begin(), log.figures().begin);
}

TEST(PacketLog, PacketNotLookedAtInTimeIsGone) {
    PacketLog log(kSmallLog);
    appendPattern(log, 0, 760);
    log.writer().publish();
    LogReader reader(log);
    for (std::uint64_t i = 1; i < 20'000; ++i) {
        appendPattern(log, i, 760);
    }
    log.writer().publish();
    EXPECT_EQ(reader.begin(), 0U);
    EXPECT_EQ(reader.end(), 1U);
    EXPECT_FALSE(reader.packet(0).has_value());
}

TEST(PacketLog, ManyTinyPacketsFillAChunkLikeFewLargeOnes) {
    constexpr LogLimits kLimits{.memoryCap = std::size_t{8} << 20, .chunkSize = std::size_t{256} << 10};
    PacketLog log(kLimits);
    constexpr std::uint64_t kCount = 200'000;
    for (std::uint64_t i = 0; i < kCount; ++i) {
        log.writer().append({}, {.stamp = Stamp(Duration(i))});
    }
    log.writer().publish();
    LogReader reader(log);
    // 32 bytes each and what is kept beside: three quarters of the cap at the least, the newest chunk may be
    // fresh.
    EXPECT_GE(reader.end() - reader.begin(), kLimits.memoryCap / (32 + kBesidePacket) * 3 / 4);
    for (std::uint64_t i = reader.begin(); i < reader.end(); ++i) {
        ASSERT_EQ(reader.packet(i)->stamp, Stamp(Duration(i)));
    }
}

TEST(PacketLog, WhatIsKeptBesideTinyPacketsIsWithinTheCap) {
    for (const std::size_t size : {24U, 60U}) {
        PacketLog log({.memoryCap = std::size_t{16} << 20, .chunkSize = std::size_t{1} << 20});
        const std::size_t cost = (size + 7) / 8 * 8 + sizeof(Record) + kBesidePacket;
        for (std::uint64_t i = 0; i < 500'000; ++i) {
            appendPattern(log, i, size);
            if (i % 1'000 == 0) {
                log.writer().publish();
                ASSERT_LE(log.figures().memoryInUse, log.figures().memoryCap);
            }
        }
        log.writer().publish();
        const LogFigures figures = log.figures();
        EXPECT_LE((figures.end - figures.begin) * cost, figures.memoryCap);
        EXPECT_GE((figures.end - figures.begin) * cost, figures.memoryCap * 3 / 4)
            << "nor is much left unused";
    }
}

TEST(PacketLog, MemoryThatTinyPacketsTakeBesideIsGivenBackByChunks) {
    PacketLog log({.memoryCap = std::size_t{8} << 20, .chunkSize = std::size_t{256} << 10});
    for (const std::size_t size : {700U, 0U, 700U, 24U, 60'000U, 1U}) {
        for (std::uint64_t i = 0; i < 100'000 / (1 + size / 500); ++i) {
            appendPattern(log, i, size);
            log.writer().publish();
            if (i % 100 == 0) {
                ASSERT_LE(log.figures().memoryAllocated, log.figures().memoryCap) << size;
            }
        }
        EXPECT_GT(log.figures().memoryInUse, log.figures().memoryCap / 2) << size;
    }
}

TEST(PacketLog, KeepsTheBeginningOfAPacketLargerThanAChunk) {
    PacketLog log(kSmallLog);
    log.writer().append(pattern(kSmallLog.chunkSize * 2, 3), {});
    log.writer().append(pattern(10, 4), {});
    log.writer().publish();
    LogReader reader(log);
    const auto packet = reader.packet(0);
    ASSERT_TRUE(packet);
    EXPECT_TRUE(packet->flags.truncated);
    EXPECT_EQ(packet->bytes.size(), kSmallLog.chunkSize - 32);
    EXPECT_TRUE(equal(reader.packet(1)->bytes, pattern(10, 4)));
}

TEST(PacketLog, SensibleLimitsWhateverIsAskedFor) {
    PacketLog log({.memoryCap = 0, .chunkSize = 1});
    for (std::uint64_t i = 0; i < 2'000; ++i) {
        appendPattern(log, i, 700);
    }
    log.writer().publish();
    EXPECT_GE(log.figures().memoryCap, std::size_t{512} << 10);
    EXPECT_EQ(LogReader(log).end(), 2'000U);
}

} // namespace
} // namespace posewire::log
