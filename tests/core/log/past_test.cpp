// SPDX-License-Identifier: MIT
#include "core/log/past.h"

#include "core/log/log_reader.h"
#include "core/log/packet_log.h"
#include "tests/core/log/log_fixture.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace posewire::log {
namespace {

/// A file in memory that can become unreadable.
class Bytes final : public ByteStore {
public:
    [[nodiscard]] std::size_t readAt(std::uint64_t offset, std::span<std::byte> into) const override {
        ++reads;
        const std::size_t rest = offset < all.size() ? all.size() - offset : 0;
        const std::size_t count = std::min(rest, into.size());
        std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(offset, all.size())),
                    count, into.begin());
        bytesRead += count;
        return count;
    }

    std::vector<std::byte> all;
    mutable std::size_t reads = 0;
    mutable std::size_t bytesRead = 0;
};

class PastTest : public testing::Test {
protected:
    static Stamp stampOf(std::uint64_t number) { return Stamp(Duration(1'000 * number)); }
    static std::size_t sizeOf(std::uint64_t number) { return 20 + number * 37 % 900; }

    [[nodiscard]] Arrival arrivalOf(std::uint64_t number) const {
        return {stampOf(number),
                m_sender,
                static_cast<std::uint32_t>(number % 3),
                {.truncated = number % 5 == 0}};
    }
    /// As many more, all of which lie in the file, with strange bytes in between.
    void append(std::size_t count, bool isInPast = true) {
        for (; count > 0; --count, ++m_next) {
            if (m_writer.isFull()) {
                m_writer.finish();
            }
            const auto bytes = pattern(sizeOf(m_next), m_next);
            m_log.writer().append(bytes, arrivalOf(m_next));
            m_writer.noteDrops(m_dropped);
            m_dropped.add(arrivalOf(m_next).kernelDropsBefore, arrivalOf(m_next).flags);
            if (isInPast && m_next % 7 == 3) {
                m_writer.keep(m_next, arrivalOf(m_next), bytes);
            } else if (isInPast) {
                m_file->all.resize(m_file->all.size() + m_next % 50);
                m_writer.add(m_next, arrivalOf(m_next), m_file->all.size(), bytes.size());
                m_file->all.insert(m_file->all.end(), bytes.begin(), bytes.end());
            }
        }
        m_log.writer().publish();
        m_reader.refresh();
    }
    [[nodiscard]] bool isAsItWas(std::uint64_t number) {
        const auto packet = m_reader.packet(number);
        const Arrival arrival = arrivalOf(number);
        return packet && packet->number == number && packet->stamp == arrival.stamp &&
               packet->sender == arrival.sender && packet->kernelDropsBefore == arrival.kernelDropsBefore &&
               packet->flags == arrival.flags && equal(packet->bytes, pattern(sizeOf(number), number));
    }
    /// Of what is in memory.
    [[nodiscard]] std::uint64_t beginOfMemory() const { return m_log.figures().begin; }

    PacketLog m_log{kSmallLog};
    SenderId m_sender = m_log.senders().intern({"10.0.0.1:5", Transport::Udp, 9763});
    std::shared_ptr<Bytes> m_file = std::make_shared<Bytes>();
    PastWriter m_writer{m_log.past(), m_log.senders(), m_file};
    LogReader m_reader{m_log};
    std::uint64_t m_next = 0;
    DropSums m_dropped; ///< before that
};

TEST_F(PastTest, EveryPacketIsAsItWasWhereverItLies) {
    append(20'000);
    ASSERT_GT(beginOfMemory(), 15'000U);
    EXPECT_EQ(m_reader.begin(), 0U);
    for (std::uint64_t number = 0; number < m_next; ++number) {
        ASSERT_TRUE(isAsItWas(number)) << number;
    }
    for (std::uint64_t number = m_next; number-- > 0;) {
        ASSERT_TRUE(isAsItWas(number)) << number;
    }
}

TEST_F(PastTest, PlacesFarFromEachOtherAreReadOneByOne) {
    append(60'000);
    m_file->bytesRead = 0;
    std::size_t wanted = 0;
    for (std::uint64_t i = 0; i < 1'000; ++i) {
        const std::uint64_t number = i * 7'919 % beginOfMemory();
        ASSERT_TRUE(isAsItWas(number));
        wanted += sizeOf(number);
    }
    EXPECT_LE(m_file->bytesRead, wanted);
}

TEST_F(PastTest, PacketsInARowAreReadManyAtOnce) {
    append(20'000);
    m_file->reads = 0;
    for (std::uint64_t number = 0; number < 10'000; ++number) {
        ASSERT_TRUE(isAsItWas(number));
    }
    EXPECT_LT(m_file->reads, 200U);
}

TEST_F(PastTest, WhatWasReadLastStaysAsLongAsTheReaderSays) {
    append(30'000);
    std::vector<Packet> packets;
    for (std::uint64_t i = 0; i < PastReader::kHeld; ++i) {
        packets.push_back(*m_reader.packet(i * 101));
    }
    for (const Packet& packet : packets) {
        ASSERT_TRUE(equal(packet.bytes, pattern(sizeOf(packet.number), packet.number)));
    }
}

TEST_F(PastTest, LiesInSeveralFiles) {
    append(5'000);
    m_writer.finish();
    const auto second = std::make_shared<Bytes>();
    PastWriter writer(m_log.past(), m_log.senders(), second);
    for (const std::uint64_t end = m_next + 5'000; m_next < end; ++m_next) {
        const auto bytes = pattern(sizeOf(m_next), m_next);
        m_log.writer().append(bytes, arrivalOf(m_next));
        writer.add(m_next, arrivalOf(m_next), second->all.size(), bytes.size());
        second->all.insert(second->all.end(), bytes.begin(), bytes.end());
    }
    writer.finish();
    append(10'000, false);
    for (std::uint64_t number = 0; number < 10'000; number += number % 3 == 0 ? 1 : 4'567) {
        ASSERT_TRUE(isAsItWas(number)) << number;
        ASSERT_TRUE(isAsItWas(9'999 - number)) << number;
    }
}

TEST_F(PastTest, AFollowerThatMemoryHasOvertakenFindsAllInTheFile) {
    LogFollower follower(m_log);
    append(20'000);
    follower.refresh();
    std::uint64_t taken = 0;
    while (const auto packet = follower.next(beginOfMemory())) {
        ASSERT_EQ(packet->number, taken++);
    }
    EXPECT_EQ(taken, beginOfMemory());
    EXPECT_EQ(follower.overtaken(), 0U);
}

TEST_F(PastTest, WhatMemoryDroppedBeforeItWasWrittenIsPassedOverAndCounted) {
    append(5'000);
    append(10'000, false); // the disk was too slow
    append(10'000);
    LogFollower follower(m_log, 0);
    std::uint64_t taken = 0;
    while (follower.next()) {
        ++taken;
    }
    EXPECT_EQ(taken + follower.overtaken(), m_next);
    EXPECT_GE(follower.overtaken(), 10'000U);
    EXPECT_LT(follower.overtaken(), 15'000U);
    EXPECT_FALSE(m_reader.packet(9'000));
    EXPECT_TRUE(isAsItWas(100));
    EXPECT_TRUE(isAsItWas(16'000));
}

TEST_F(PastTest, KnowsWhatWasDroppedBeforeAPacketThatLiesInAFile) {
    append(5'000);
    append(10'000, false);
    append(10'000);
    LogFollower follower(m_log, 0);
    std::uint64_t seen = 0;
    std::uint64_t unseen = 0;
    while (const auto packet = follower.next()) {
        seen += packet->kernelDropsBefore;
        unseen += follower.takeUnseen().datagrams;
    }
    EXPECT_GT(unseen, 9'000U);
    EXPECT_EQ(seen + unseen, m_dropped.datagrams);
    m_log.past().dropBefore(20'000); // the oldest files go
    LogFollower behind(m_log, 0);
    const auto first = behind.next();
    ASSERT_TRUE(first && first->number > 15'000);
    std::uint64_t before = 0;
    for (std::uint64_t number = 0; number < first->number; ++number) {
        before += arrivalOf(number).kernelDropsBefore;
    }
    EXPECT_EQ(behind.takeUnseen().datagrams, before);
}

TEST_F(PastTest, FindsTheNextPacketBehindWhatIsMissing) {
    append(5'000);
    m_writer.finish();
    append(10'000, false);
    append(10'000);
    m_writer.finish();
    const std::uint64_t behind = beginOfMemory() < 15'000 ? beginOfMemory() : 15'000;
    const auto next = [this](std::uint64_t from) {
        const auto packet = m_reader.packetFrom(from);
        return packet ? packet->number : UINT64_MAX;
    };
    EXPECT_EQ(next(0), 0U);
    EXPECT_EQ(next(4'999), 4'999U);
    EXPECT_EQ(next(5'000), behind);
    EXPECT_EQ(next(behind - 1), behind);
    EXPECT_EQ(next(m_next - 1), m_next - 1);
    EXPECT_EQ(next(m_next), UINT64_MAX);
    m_log.past().dropBefore(UINT64_MAX);
    m_reader.refresh();
    EXPECT_EQ(next(0), beginOfMemory());
}

TEST_F(PastTest, AFileThatWasCutShortLosesItsPacketsAndNothingElse) {
    append(20'000);
    m_file->all.resize(m_file->all.size() / 4);
    EXPECT_TRUE(isAsItWas(10));
    EXPECT_FALSE(m_log.past().isDamaged()) << "nobody has looked";
    EXPECT_FALSE(m_reader.packet(12'000));
    EXPECT_TRUE(m_log.past().isDamaged());
    EXPECT_TRUE(isAsItWas(m_next - 1)) << "that one is in memory";
}

TEST_F(PastTest, ForgetsPartByPart) {
    append(20'000);
    m_log.past().dropBefore(5'000);
    m_reader.refresh();
    EXPECT_GT(m_reader.begin(), 5'000U - Past::kPacketsOfPart);
    EXPECT_LE(m_reader.begin(), 5'000U);
    EXPECT_FALSE(m_reader.packet(m_reader.begin() - 1));
    EXPECT_TRUE(isAsItWas(5'000));
    m_log.past().dropBefore(UINT64_MAX);
    m_reader.refresh();
    EXPECT_EQ(m_reader.begin(), beginOfMemory());
}

TEST_F(PastTest, KeepsTheSendersOfItsPackets) {
    append(20'000);
    const SenderId other = m_log.senders().intern({"10.0.0.2:6", Transport::Udp, 9763});
    m_sender = other;
    append(20'000);
    for (int i = 0; i < 2'000; ++i) { // more than the table keeps by itself
        static_cast<void>(m_log.senders().intern({"flood:" + std::to_string(i), Transport::Udp, 1}));
    }
    const auto packet = m_reader.packet(1);
    ASSERT_TRUE(packet);
    ASSERT_NE(m_log.senders().find(packet->sender), nullptr);
    EXPECT_EQ(m_log.senders().find(packet->sender)->address, "10.0.0.1:5");
}

TEST(FilesThatCanBeReadAnywhere, AreNoPipesAndNoFolders) {
    EXPECT_FALSE(openStore("/dev/stdin/none"));
    EXPECT_FALSE(openStore(std::filesystem::temp_directory_path().string()));
    EXPECT_FALSE(openStore("/dev/null"));
    EXPECT_FALSE(openStore("NUL"));
}

} // namespace
} // namespace posewire::log
