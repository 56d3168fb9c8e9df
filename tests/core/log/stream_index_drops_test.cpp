// SPDX-License-Identifier: MIT
#include "core/log/stream_index.h"

#include "core/log/packet_log.h"
#include "tests/core/log/datagram_fixture.h"
#include "tests/core/log/log_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace posewire::log {
namespace {

/// What an index is to know of a packet of the log.
struct Sent {
    std::uint64_t number;
    StreamKey key;
    Stamp stamp;
    std::uint32_t sample;
};

class StreamIndexDropsTest : public testing::Test {
protected:
    void append(const StreamKey& key, std::uint32_t sample) {
        ByteVector bytes = poseDatagram(sample, 40);
        bytes[4] = static_cast<std::byte>('0' + key.type / 10);
        bytes[5] = static_cast<std::byte>('0' + key.type % 10);
        bytes[16] = static_cast<std::byte>(key.character);
        m_stamp += Duration(m_random() % 1000);
        m_log.writer().append(bytes, {.stamp = m_stamp, .sender = key.sender});
        m_log.writer().publish();
        m_sent.push_back({m_sent.size(), key, m_stamp, sample});
    }
    void appendAny(std::size_t count) {
        for (; count > 0; --count) {
            const StreamKey key{static_cast<SenderId>(m_random() % 2),
                                static_cast<std::uint8_t>(m_random() % 3),
                                static_cast<std::uint8_t>(m_random() % 2 == 0 ? 2 : 25)};
            append(key, ++m_samples[key]);
        }
    }
    /// What Ingest does: takes in what is new, drops what the log has dropped. True if `limit` packets were
    /// enough.
    bool follow(std::uint64_t limit = UINT64_MAX) {
        m_reader.refresh();
        m_next = std::max(m_next, m_reader.begin());
        for (; m_next < m_reader.end() && limit > 0; ++m_next, --limit) {
            const auto packet = m_reader.packet(m_next);
            m_index.add(*packet, *wire::decodeHeader(packet->bytes));
        }
        m_index.dropBefore(m_reader.begin());
        return m_next == m_reader.end();
    }
    /// The index has exactly the packets from `begin` to before `end`, each in its stream.
    void expectHolds(std::uint64_t begin, std::uint64_t end) {
        std::map<StreamKey, std::vector<Sent>> streams;
        for (const Sent& one : m_sent) {
            streams.try_emplace(one.key);
        }
        for (std::uint64_t number = begin; number < end; ++number) {
            streams[m_sent[number].key].push_back(m_sent[number]);
        }
        for (const auto& [key, sent] : streams) {
            const StreamEntries* entries = m_index.find(key);
            ASSERT_EQ(entries != nullptr, !sent.empty());
            if (entries == nullptr) {
                continue;
            }
            ASSERT_EQ(entries->size(), sent.size());
            for (std::size_t i = 0; i < sent.size(); ++i) {
                ASSERT_EQ((*entries)[i].packet, sent[i].number);
                ASSERT_EQ((*entries)[i].stamp, sent[i].stamp);
                ASSERT_EQ((*entries)[i].sample, sent[i].sample);
            }
            EXPECT_EQ(entries->atOrBeforePacket(sent.front().number), 0U);
            EXPECT_EQ(entries->atOrBeforePacket(sent.back().number), sent.size() - 1);
            if (sent.front().number > 0) {
                EXPECT_EQ(entries->atOrBeforePacket(sent.front().number - 1), std::nullopt);
            }
        }
    }

    std::mt19937 m_random{9};
    PacketLog m_log{kSmallLog};
    LogReader m_reader{m_log};
    StreamIndex m_index;
    std::uint64_t m_next = 0;
    std::vector<Sent> m_sent;
    Stamp m_stamp{};
    std::map<StreamKey, std::uint32_t> m_samples;
};

/// About 780 packets fit: an index that looks now and then misses what was dropped in between.
TEST_F(StreamIndexDropsTest, HasWhatTheLogHoldsHoweverSeldomItLooks) {
    for (int round = 0; round < 25; ++round) {
        appendAny(m_random() % 2 == 0 ? m_random() % 50 : m_random() % 2000);
        EXPECT_TRUE(follow());
        expectHolds(m_reader.begin(), m_reader.end());
    }
    EXPECT_GT(m_reader.begin(), 1000U);
}

TEST_F(StreamIndexDropsTest, GoesOnBehindAGapThatWasDroppedBeforeItsTurn) {
    appendAny(700);
    EXPECT_FALSE(follow(100));
    expectHolds(0, 100);
    appendAny(5000);
    EXPECT_FALSE(follow(50));
    EXPECT_GT(m_reader.begin(), 100U);
    expectHolds(m_reader.begin(), m_reader.begin() + 50);
    while (!follow(50)) {
    }
    expectHolds(m_reader.begin(), m_reader.end());
}

TEST_F(StreamIndexDropsTest, FindsTheNewestAtOrBeforeAnyStamp) {
    appendAny(3000);
    follow();
    for (const auto& [key, sample] : m_samples) {
        ASSERT_NE(m_index.find(key), nullptr);
        const StreamEntries& entries = *m_index.find(key);
        for (int i = 0; i < 200; ++i) {
            const Stamp stamp =
                m_sent[m_random() % m_sent.size()].stamp + Duration(m_random() % 3) - Duration(1);
            std::optional<std::size_t> expected;
            for (std::size_t k = 0; k < entries.size() && entries[k].stamp <= stamp; ++k) {
                expected = k;
            }
            ASSERT_EQ(entries.atOrBeforeStamp(stamp), expected);
        }
    }
}

TEST_F(StreamIndexDropsTest, ForgetsAStreamThatIsSilentOnceItsLastPacketIsDropped) {
    const StreamKey silent{SenderId{7}, 9, 13};
    append(silent, 0);
    appendAny(300);
    follow();
    ASSERT_NE(m_index.find(silent), nullptr);
    appendAny(3000);
    follow();
    EXPECT_EQ(m_index.find(silent), nullptr);
    append(silent, 1);
    follow();
    ASSERT_NE(m_index.find(silent), nullptr) << "it may come again";
    EXPECT_EQ(m_index.find(silent)->size(), 1U);
}

TEST_F(StreamIndexDropsTest, ForgetsByNumberAndNeverTwice) {
    appendAny(600);
    follow();
    m_index.dropBefore(250);
    expectHolds(250, 600);
    m_index.dropBefore(100);
    expectHolds(250, 600);
    m_index.dropBefore(600);
    expectHolds(600, 600);
    m_index.dropBefore(10'000);
    expectHolds(600, 600);
}

TEST(StreamEntriesTest, AreDroppedAtAnyPlace) {
    for (const std::uint64_t dropped : {0U, 1U, 255U, 256U, 257U, 511U, 512U, 700U, 767U, 768U}) {
        StreamEntries entries;
        for (std::uint64_t number = 0; number < 768; ++number) {
            entries.append({number, Stamp(Duration(number)), static_cast<std::uint32_t>(number), 0, true});
        }
        entries.dropBefore(dropped);
        ASSERT_EQ(entries.size(), 768 - dropped);
        EXPECT_EQ(entries.empty(), dropped == 768);
        for (std::uint64_t number = 768; number < 1100; ++number) {
            entries.append({number, Stamp(Duration(number)), static_cast<std::uint32_t>(number), 0, true});
        }
        ASSERT_EQ(entries.size(), 1100 - dropped);
        for (std::size_t i = 0; i < entries.size(); ++i) {
            ASSERT_EQ(entries[i].packet, dropped + i);
            ASSERT_EQ(entries[i].sample, dropped + i);
        }
        entries.dropBefore(UINT64_MAX);
        EXPECT_TRUE(entries.empty());
    }
}

} // namespace
} // namespace posewire::log
