// SPDX-License-Identifier: MIT
#include "core/log/stream_index.h"

#include "core/log/packet_log.h"
#include "tests/core/log/datagram_fixture.h"
#include "tests/core/log/log_fixture.h"

#include <gtest/gtest.h>

namespace posewire::log {
namespace {

using namespace std::chrono_literals;

/// A header without a body: enough to be indexed.
ByteVector headerOnly(std::uint8_t type, std::uint8_t character, std::uint32_t sample,
                      std::uint8_t counter = 0x80) {
    ByteVector bytes = poseDatagram(sample, 0);
    bytes[4] = static_cast<std::byte>('0' + type / 10);
    bytes[5] = static_cast<std::byte>('0' + type % 10);
    bytes[10] = static_cast<std::byte>(counter);
    bytes[16] = static_cast<std::byte>(character);
    return bytes;
}

class StreamIndexTest : public ::testing::Test {
protected:
    void append(const ByteVector& bytes, Duration time, SenderId sender = SenderId{}) {
        m_log.writer().append(bytes, {.stamp = Stamp(time), .sender = sender});
        m_log.writer().publish();
    }
    bool follow(std::uint64_t limit = UINT64_MAX) {
        m_reader.refresh();
        return m_index.follow(m_reader, limit);
    }

    PacketLog m_log{kSmallLog};
    LogReader m_reader{m_log};
    StreamIndex m_index;
};

TEST_F(StreamIndexTest, KeepsStreamsApartBySenderCharacterAndType) {
    append(headerOnly(2, 0, 1), 10ns);
    append(headerOnly(2, 1, 1), 20ns);
    append(headerOnly(25, 0, 1), 30ns);
    append(headerOnly(2, 0, 1), 40ns, SenderId{1});
    append(headerOnly(2, 0, 2), 50ns);
    EXPECT_TRUE(follow());
    EXPECT_EQ(m_index.streams().size(), 4U);
    const StreamEntries* entries = m_index.find({SenderId{}, 0, 2});
    ASSERT_NE(entries, nullptr);
    ASSERT_EQ(entries->size(), 2U);
    EXPECT_EQ((*entries)[1].packet, 4U);
    EXPECT_EQ((*entries)[1].stamp, Stamp(50ns));
    EXPECT_EQ((*entries)[1].sample, 2U);
    EXPECT_EQ(m_index.find({SenderId{2}, 0, 2}), nullptr);
}

TEST_F(StreamIndexTest, KnowsTheParts) {
    append(headerOnly(13, 0, 0, 0x00), 1ns);
    append(headerOnly(13, 0, 0, 0x81), 2ns);
    follow();
    const StreamEntries* entries = m_index.find({SenderId{}, 0, 13});
    ASSERT_NE(entries, nullptr);
    EXPECT_EQ((*entries)[0].datagram, 0);
    EXPECT_FALSE((*entries)[0].isLast);
    EXPECT_EQ((*entries)[1].datagram, 1);
    EXPECT_TRUE((*entries)[1].isLast);
}

TEST_F(StreamIndexTest, FindsTheNewestAtOrBefore) {
    for (std::uint32_t i = 0; i < 1000; ++i) {
        append(headerOnly(2, 0, i), 100ns + 10 * Duration(i));
    }
    follow();
    const StreamEntries& entries = *m_index.find({SenderId{}, 0, 2});
    EXPECT_FALSE(entries.atOrBeforeStamp(Stamp(99ns)).has_value());
    EXPECT_EQ(entries.atOrBeforeStamp(Stamp(100ns)), 0U);
    EXPECT_EQ(entries.atOrBeforeStamp(Stamp(109ns)), 0U);
    EXPECT_EQ(entries.atOrBeforeStamp(Stamp(110ns)), 1U);
    EXPECT_EQ(entries.atOrBeforeStamp(Stamp::max()), 999U);
    EXPECT_EQ(entries.atOrBeforePacket(0), 0U);
    EXPECT_EQ(entries.atOrBeforePacket(600), 600U);
    EXPECT_EQ(entries.atOrBeforePacket(UINT64_MAX), 999U);
}

TEST_F(StreamIndexTest, StampsNeverGoBackWithinAStream) {
    append(headerOnly(2, 0, 1), 100ns);
    append(headerOnly(2, 0, 2), 50ns);
    append(headerOnly(2, 0, 3), 150ns);
    follow();
    const StreamEntries& entries = *m_index.find({SenderId{}, 0, 2});
    EXPECT_EQ(entries[1].stamp, Stamp(100ns));
    EXPECT_EQ(entries.atOrBeforeStamp(Stamp(120ns)), 1U);
}

TEST_F(StreamIndexTest, LeavesOutWhatHasNoHeader) {
    append(textBytes("{\"type\":\"transport\"}"), 1ns);
    append(textBytes("MXTP02"), 2ns);
    append({}, 3ns);
    m_log.writer().append(headerOnly(2, 0, 1), {.stamp = Stamp(4ns), .flags = {.skipped = true}});
    append(headerOnly(2, 0, 1), 5ns);
    follow();
    ASSERT_EQ(m_index.streams().size(), 1U);
    EXPECT_EQ(m_index.find(m_index.streams()[0])->size(), 1U);
    EXPECT_EQ(m_index.end(), 5U);
}

TEST_F(StreamIndexTest, GoesOnWhereItStoppedAndInPortions) {
    for (std::uint32_t i = 0; i < 100; ++i) {
        append(headerOnly(2, 0, i), Duration(i));
    }
    EXPECT_FALSE(follow(30));
    EXPECT_EQ(m_index.end(), 30U);
    EXPECT_FALSE(follow(69));
    EXPECT_TRUE(follow(1));
    EXPECT_TRUE(follow());
    EXPECT_EQ(m_index.find({SenderId{}, 0, 2})->size(), 100U);
}

TEST_F(StreamIndexTest, IsTrimmedTogetherWithTheLog) {
    append(headerOnly(12, 0, 0), 0ns);
    for (std::uint32_t i = 0; i < 60'000; ++i) {
        append(headerOnly(2, 0, i), Duration(i));
        if (i % 1000 == 0) {
            follow();
        }
    }
    follow();
    ASSERT_GT(m_reader.begin(), 0U);
    const StreamEntries& entries = *m_index.find({SenderId{}, 0, 2});
    EXPECT_EQ(entries.size(), m_reader.end() - m_reader.begin());
    EXPECT_EQ(entries[0].packet, m_reader.begin());
    EXPECT_EQ(entries.back().packet, m_reader.end() - 1);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        ASSERT_EQ(entries[i].packet, m_reader.begin() + i);
    }
    EXPECT_EQ(m_index.find({SenderId{}, 0, 12}), nullptr) << "nothing is left of this stream";
    EXPECT_EQ(m_index.streams().size(), 1U);
}

TEST_F(StreamIndexTest, MadeUpStreamsAreCountedNotKept) {
    for (std::uint32_t i = 0; i < 6000; ++i) {
        append(headerOnly(static_cast<std::uint8_t>(i / 256), static_cast<std::uint8_t>(i % 256), i),
               Duration(i));
    }
    follow();
    EXPECT_EQ(m_index.streams().size(), StreamIndex::kStreamLimit);
    EXPECT_EQ(m_index.unindexed(), 6000 - StreamIndex::kStreamLimit);
}

TEST_F(StreamIndexTest, VersionTellsThatStreamsCameOrWent) {
    const auto before = m_index.version();
    append(headerOnly(2, 0, 1), 1ns);
    follow();
    const auto after = m_index.version();
    EXPECT_NE(after, before);
    append(headerOnly(2, 0, 2), 2ns);
    follow();
    EXPECT_EQ(m_index.version(), after);
    m_index.dropBefore(2);
    EXPECT_NE(m_index.version(), after);
    EXPECT_TRUE(m_index.streams().empty());
}

} // namespace
} // namespace posewire::log
