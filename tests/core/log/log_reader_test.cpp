// SPDX-License-Identifier: MIT
#include "core/log/log_reader.h"

#include "tests/core/log/log_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <list>
#include <numeric>
#include <random>

namespace posewire::log {
namespace {

std::size_t sizeOf(std::uint64_t number) {
    return static_cast<std::size_t>(number * 2'654'435'761U % 1800);
}

class LogReaderTest : public testing::Test {
protected:
    void append(std::uint64_t count) {
        for (; count > 0; --count, ++m_end) {
            m_log.writer().append(pattern(sizeOf(m_end), m_end), {.stamp = Stamp(Duration(m_end))});
        }
        m_log.writer().publish();
    }
    /// Whatever a reader gives is the packet of that number.
    static void expectIntact(const Packet& packet, std::uint64_t number) {
        ASSERT_EQ(packet.number, number);
        ASSERT_EQ(packet.stamp, Stamp(Duration(number)));
        ASSERT_TRUE(equal(packet.bytes, pattern(sizeOf(number), number))) << number;
    }
    /// More than the log can hold.
    static constexpr std::uint64_t kMoreThanFits = 3000;

    PacketLog m_log{kSmallLog};
    std::uint64_t m_end = 0;
};

TEST_F(LogReaderTest, GivesEveryPacketInAnyOrder) {
    append(800);
    LogReader reader(m_log);
    ASSERT_EQ(reader.begin(), 0U);
    std::vector<std::uint64_t> numbers(800);
    std::iota(numbers.begin(), numbers.end(), std::uint64_t{0});
    std::mt19937 random(1);
    std::shuffle(numbers.begin(), numbers.end(), random);
    for (const std::uint64_t number : numbers) {
        const auto packet = reader.packet(number);
        ASSERT_TRUE(packet);
        expectIntact(*packet, number);
    }
}

TEST_F(LogReaderTest, GivesNothingOutsideOfItsLook) {
    append(kMoreThanFits);
    LogReader reader(m_log);
    append(10);
    ASSERT_GT(reader.begin(), 0U);
    for (const std::uint64_t number : {std::uint64_t{0}, reader.begin() - 1, reader.end(), reader.end() + 5,
                                       std::uint64_t{1} << 32, UINT64_MAX}) {
        EXPECT_FALSE(reader.packet(number)) << number;
    }
    const auto oldest = reader.packet(reader.begin());
    ASSERT_TRUE(oldest);
    expectIntact(*oldest, reader.begin());
    for (const std::uint64_t number : {std::uint64_t{0}, reader.begin() - 1, reader.end(), UINT64_MAX}) {
        EXPECT_FALSE(reader.packet(number)) << number << ", also while it holds a chunk";
    }
}

TEST_F(LogReaderTest, SaysWhetherThereIsAnythingNew) {
    LogReader reader(m_log);
    EXPECT_FALSE(reader.refresh());
    append(1);
    EXPECT_TRUE(reader.refresh());
    EXPECT_FALSE(reader.refresh());
    append(kMoreThanFits);
    EXPECT_EQ(reader.begin(), 0U) << "it moves in refresh() only";
    EXPECT_EQ(reader.end(), 1U);
    EXPECT_TRUE(reader.refresh());
    EXPECT_EQ(reader.end(), kMoreThanFits + 1);
    EXPECT_EQ(reader.begin(), m_log.figures().begin);
}

/// Overtaken: what it had looked at stays, the rest is gone, and nothing is ever wrong.
TEST_F(LogReaderTest, KeepsTheChunkItLooksAtWhenItIsOvertaken) {
    append(600);
    LogReader reader(m_log);
    std::vector<std::uint64_t> held;
    const auto looked = reader.packet(300);
    ASSERT_TRUE(looked);
    append(2 * kMoreThanFits);
    expectIntact(*looked, 300);
    std::size_t gone = 0;
    for (std::uint64_t number = reader.begin(); number < reader.end(); ++number) {
        if (const auto packet = reader.packet(number)) {
            expectIntact(*packet, number);
            held.push_back(number);
        } else {
            ++gone;
        }
    }
    ASSERT_GT(gone, 0U);
    ASSERT_TRUE(std::ranges::binary_search(held, 300U));
    EXPECT_EQ(held.back() - held.front() + 1, held.size()) << "one chunk, without gaps";
    reader.refresh();
    EXPECT_GT(reader.begin(), 600U);
    EXPECT_FALSE(reader.packet(300));
}

TEST_F(LogReaderTest, FollowsAWriterThatOvertakesItAgainAndAgain) {
    LogReader reader(m_log);
    std::mt19937 random(2);
    std::uint64_t next = 0;
    std::uint64_t read = 0;
    std::uint64_t missed = 0;
    for (int round = 0; round < 60; ++round) {
        append(random() % 2 == 0 ? random() % 100 : random() % kMoreThanFits);
        reader.refresh();
        ASSERT_EQ(reader.end(), m_end);
        missed += reader.begin() > next ? reader.begin() - next : 0;
        for (next = std::max(next, reader.begin()); next < reader.end(); ++next) {
            const auto packet = reader.packet(next);
            ASSERT_TRUE(packet) << "nothing was written meanwhile";
            expectIntact(*packet, next);
            ++read;
        }
    }
    EXPECT_EQ(read + missed, m_end);
    EXPECT_GT(missed, 0U);
}

/// Readers hold on to chunks by themselves: what one lets go another may keep.
TEST_F(LogReaderTest, IsIndependentOfOtherReaders) {
    append(500);
    LogReader first(m_log);
    LogReader second(m_log);
    const auto one = first.packet(10);
    const auto other = second.packet(10);
    ASSERT_TRUE(one && other);
    EXPECT_EQ(one->bytes.data(), other->bytes.data()) << "no copies";
    append(kMoreThanFits);
    first.refresh();
    EXPECT_FALSE(first.packet(10));
    expectIntact(*other, 10);
    EXPECT_TRUE(second.packet(10));
}

TEST_F(LogReaderTest, GivesMemoryBackWithTheLastReader) {
    append(500);
    {
        std::list<LogReader> readers;
        for (int i = 0; i < 5; ++i) {
            readers.emplace_back(m_log);
            ASSERT_TRUE(readers.back().packet(readers.back().begin()));
            append(kMoreThanFits);
        }
        EXPECT_GT(m_log.figures().memoryAllocated, m_log.figures().memoryInUse);
    }
    append(kMoreThanFits);
    const LogFigures figures = m_log.figures();
    EXPECT_LE(figures.memoryInUse, kSmallLog.memoryCap);
    EXPECT_GT(figures.memoryInUse, kSmallLog.memoryCap - kSmallLog.chunkSize);
    EXPECT_LE(figures.memoryAllocated, 2 * kSmallLog.memoryCap) << "spare chunks are bounded by the cap";
}

TEST_F(LogReaderTest, SeesAnEmptyLookWhereAllOfItWasDropped) {
    append(5);
    LogReader reader(m_log);
    append(kMoreThanFits);
    EXPECT_FALSE(reader.packet(0));
    EXPECT_EQ(reader.end() - reader.begin(), 5U) << "its look is as it was";
}

struct Limits {
    LogLimits asked;
    LogLimits kept;
};

TEST(LogLimits, AreBroughtWithinReason) {
    constexpr std::size_t kib = 1024;
    constexpr std::size_t mib = 1024 * kib;
    for (const auto& [asked, kept] :
         {Limits{{0, 0}, {768 * kib, 256 * kib}}, Limits{{mib, mib}, {3 * mib, mib}},
          Limits{{4 * mib, mib + 5}, {4 * mib, mib}}, Limits{{3 * mib, 2 * mib}, {6 * mib, 2 * mib}},
          Limits{{mib + 1, 256 * kib}, {mib + 1, 256 * kib}}}) {
        const ChunkHistory history(asked);
        EXPECT_EQ(history.limits().chunkSize, kept.chunkSize);
        EXPECT_EQ(history.limits().memoryCap, kept.memoryCap);
        EXPECT_EQ(history.figures().memoryCap, kept.memoryCap);
        EXPECT_EQ(history.figures().memoryInUse, 0U);
        EXPECT_EQ(history.end(), 0U);
    }
}

/// Records grow from the front and bytes from the back until they meet.
TEST(ChunkOfALog, HasRoomUntilRecordsAndBytesMeet) {
    Chunk chunk(4096);
    EXPECT_EQ(chunk.room(), 4096U);
    std::size_t room = chunk.room();
    std::size_t count = 0;
    const std::byte* end = nullptr;
    while (room >= sizeof(Record) + 40) {
        const std::byte* bytes = chunk.take(40);
        EXPECT_TRUE(end == nullptr || bytes + 40 == end);
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(bytes) % 8, 0U);
        end = bytes;
        chunk.addRecord({bytes, Stamp(Duration(count++)), 40, {}, 0, {}});
        room -= sizeof(Record) + 40;
        EXPECT_EQ(chunk.room(), room);
    }
    EXPECT_EQ(count, 4096U / 72);
    for (std::size_t i = 0; i < count; ++i) {
        EXPECT_EQ(chunk.record(i).stamp, Stamp(Duration(i)));
    }
    chunk.clear();
    EXPECT_EQ(chunk.room(), 4096U);
}

} // namespace
} // namespace posewire::log
