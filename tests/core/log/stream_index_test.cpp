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
    /// What Ingest does: drops what the log has dropped, takes in what is new.
    void follow() {
        m_reader.refresh();
        m_index.dropBefore(m_reader.begin());
        for (m_next = std::max(m_next, m_reader.begin()); m_next < m_reader.end(); ++m_next) {
            const auto packet = m_reader.packet(m_next);
            m_index.add(*packet, *wire::decodeHeader(packet->bytes));
        }
    }

    PacketLog m_log{kSmallLog};
    LogReader m_reader{m_log};
    StreamIndex m_index;
    std::uint64_t m_next = 0;
};

TEST_F(StreamIndexTest, KeepsStreamsApartBySenderCharacterAndType) {
    append(headerOnly(2, 0, 1), 10ns);
    append(headerOnly(2, 1, 1), 20ns);
    append(headerOnly(25, 0, 1), 30ns);
    append(headerOnly(2, 0, 1), 40ns, SenderId{1});
    append(headerOnly(2, 0, 2), 50ns);
    follow();
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
}

TEST_F(StreamIndexTest, MadeUpStreamsBeyondTheLimitAreLeftOut) {
    for (std::uint32_t i = 0; i < 6000; ++i) {
        append(headerOnly(static_cast<std::uint8_t>(i / 256), static_cast<std::uint8_t>(i % 256), i),
               Duration(i));
    }
    follow();
    const auto isKept = [this](std::size_t i) {
        return m_index.find({SenderId{}, static_cast<std::uint8_t>(i % 256),
                             static_cast<std::uint8_t>(i / 256)}) != nullptr;
    };
    EXPECT_TRUE(isKept(StreamIndex::kStreamLimit - 1));
    EXPECT_FALSE(isKept(StreamIndex::kStreamLimit));
}

TEST_F(StreamIndexTest, ForgetsAStreamOfWhichNothingIsLeft) {
    append(headerOnly(2, 0, 1), 1ns);
    append(headerOnly(2, 0, 2), 2ns);
    follow();
    m_index.dropBefore(1);
    EXPECT_NE(m_index.find({SenderId{}, 0, 2}), nullptr);
    m_index.dropBefore(2);
    EXPECT_EQ(m_index.find({SenderId{}, 0, 2}), nullptr);
}

} // namespace
} // namespace posewire::log
