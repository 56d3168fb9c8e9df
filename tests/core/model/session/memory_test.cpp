// SPDX-License-Identifier: MIT
#include "tests/core/model/session/session_fixture.h"

#include "core/model/accounting/attribution.h"
#include "core/model/body/null_pose.h"
#include "core/model/session/memory_figures.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <string>

namespace posewire::model {
namespace {

/// Whatever comes, each part keeps its limit.
class MemoryTest : public testing::Test {
protected:
    void send(wire::Body body, std::uint32_t sample, std::uint8_t character = 0,
              std::uint8_t datagramCounter = 0x80, const std::string& address = "10.0.0.2:40001") {
        wire::Datagram datagram;
        datagram.body = std::move(body);
        datagram.header.sampleCounter = sample;
        datagram.header.character = character;
        datagram.header.datagramCounter = datagramCounter;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        sendBytes(*wire::encode(datagram), address);
    }
    void sendBytes(wire::Bytes bytes, const std::string& address = "10.0.0.2:40001") {
        m_log.writer().append(bytes, {.stamp = m_at, .sender = m_log.senders().intern({address, {}, 9763})});
        m_log.writer().publish();
        if (++m_sent % 1'000 == 0) {
            follow();
        }
    }
    void follow() {
        m_session.follow(m_at);
        expectWithinBudget();
    }
    void expectWithinBudget() {
        const MemoryFigures figures = m_session.memory();
        std::size_t sum = 0;
        for (const MemoryFigures::Part& part : figures.parts) {
            if (part.key != "log" && part.key != "index") {
                EXPECT_LE(part.bytes, part.most) << part.key;
            }
            sum += part.bytes;
        }
        EXPECT_LE(bytesOf("log") + bytesOf("index"), m_log.figures().memoryCap);
        EXPECT_EQ(figures.sum(), sum);
        EXPECT_LE(sum, figures.budget());
    }
    [[nodiscard]] std::size_t bytesOf(std::string_view key) const {
        const MemoryFigures figures = m_session.memory();
        const auto part = std::ranges::find(figures.parts, key, &MemoryFigures::Part::key);
        return part == figures.parts.end() ? 0 : part->bytes;
    }
    [[nodiscard]] log::StreamKey streamKey(std::uint8_t type) const {
        return {m_session.roster().senders().front().id, 0, type};
    }

    log::PacketLog m_log{{.memoryCap = std::size_t{48} << 20, .chunkSize = std::size_t{1} << 20}};
    Session m_session{m_log};
    log::Stamp m_at{100s};
    std::uint64_t m_sent = 0;
};

TEST_F(MemoryTest, OfTinyDatagramsIsThatOfTheLog) {
    for (std::uint32_t sample = 0; sample < 600'000; ++sample, m_at += 10us) {
        const std::array<std::byte, 30> junk{};
        sendBytes(junk);
    }
    follow();
    EXPECT_GT(m_log.figures().begin, 0U);
    EXPECT_GT(bytesOf("log") + bytesOf("index"), m_log.figures().memoryCap / 2);
    EXPECT_LE(bytesOf("index"),
              (m_session.end() - m_session.begin()) * log::kBesidePacket + (std::size_t{1} << 16));
}

TEST_F(MemoryTest, OfMetadataThatAlwaysChangesIsBounded) {
    for (std::uint32_t i = 0; i < 800; ++i, m_at += 1ms) { // six times the budget
        wire::MetaData metadata;
        for (int tag = 0; tag < 64; ++tag) {
            metadata.text += std::to_string(tag) + ":" + std::to_string(i) + std::string(900, 'x') + "\n";
        }
        send(metadata, 0, static_cast<std::uint8_t>(i % 200));
    }
    follow();
    EXPECT_GT(bytesOf("metadata"), 0U);
    for (const Incident& event : m_session.verdicts().incidents().all()) {
        EXPECT_LE(say(event.detail, words::Form::Headline).size(), Incidents::kMostDetailBytes);
        EXPECT_LE(memoryBytes(event.detail), 2 * Incidents::kMostDetailBytes);
    }
}

TEST_F(MemoryTest, OfNullPosesInPartsThatAlwaysChangeIsBounded) {
    for (std::uint32_t i = 0; i < 1'200; ++i, m_at += 1ms) { // four times the budget
        wire::NullPose part;
        part.segments.assign(200, {std::string(250, 'x'), {0, 0, static_cast<float>(i)}});
        send(part, 0, static_cast<std::uint8_t>(i / 4 % 64),
             static_cast<std::uint8_t>(i % 4 == 3 ? 0x83 : i % 4));
    }
    follow();
    EXPECT_GT(bytesOf("nullPoses"), 0U);
}

TEST_F(MemoryTest, OfTheNewestMessagesIsBoundedHoweverLargeTheyAre) {
    wire::PoseQuaternion large;
    large.segments.assign(255, {1, {0, 0, 1}, {1, 0, 0, 0}});
    wire::NullPose nullPose;
    nullPose.segments.assign(200, {std::string(250, 'x'), {0, 0, 1}});
    wire::MetaData metadata;
    metadata.text = "name:" + std::string(60'000, 'x');
    for (int sender = 0; sender < 2; ++sender) {
        for (int character = 0; character < 256; ++character, m_at += 1ms) {
            const auto id = static_cast<std::uint8_t>(character);
            const std::string address = "10.0.0.2:" + std::to_string(sender);
            send(large, 1, id, 0x80, address);
            send(nullPose, 0, id, 0x80, address);
            send(metadata, 0, id, 0x80, address);
        }
    }
    follow();
    EXPECT_LT(bytesOf("messages"), std::size_t{1} << 20);
    std::size_t poses = 0;
    for (const Character& character : m_session.roster().characters()) {
        poses += m_session.messages().pose(character.key) != nullptr ? 1 : 0;
    }
    EXPECT_GT(poses, 100U) << "who asks gets it, as long as it is in the log";
    expectWithinBudget();
    for (const std::uint8_t type : std::array<std::uint8_t, 3>{2, 12, 13}) {
        EXPECT_NE(m_session.messages().message(m_session.roster().characters().back().key, type), nullptr);
        EXPECT_EQ(m_session.roster().find(streamKey(type))->newest.packet, UINT64_MAX);
    }
}

TEST_F(MemoryTest, OfALargeMessageIsNotLeftToAStreamThatBeginsSmall) {
    wire::PoseQuaternion large;
    large.segments.assign(255, {1, {0, 0, 1}, {1, 0, 0, 0}});
    wire::PoseQuaternion small;
    small.segments.assign(23, {1, {0, 0, 1}, {1, 0, 0, 0}});
    for (int character = 0; character < 50; ++character, m_at += 1ms) {
        send(large, 1, 255);
        send(small, 1, static_cast<std::uint8_t>(character));
    }
    follow();
    for (const Stream& stream : m_session.roster().streams()) {
        const auto* pose = std::get_if<wire::PoseQuaternion>(&stream.newest.datagram.body);
        if (pose != nullptr) {
            EXPECT_LE(pose->segments.capacity() * sizeof(pose->segments[0]), Ingest::kMostNewestBytes);
        }
    }
    const Stream* stream = m_session.roster().find(streamKey(2));
    ASSERT_NE(stream, nullptr);
    const Message* message = m_session.messages().message({stream->key.sender, 0}, 2);
    EXPECT_EQ(message, &stream->newest) << "which is at hand without decoding it again";
}

TEST_F(MemoryTest, OfManyStreamsIsThatOfAFewHundred) {
    const auto streamsFrom = [this](int senders) {
        for (int sender = 0; sender < senders; ++sender) {
            for (int character = 0; character < 256; ++character) {
                for (std::uint32_t sample = 1; sample <= 3; ++sample) {
                    send(wire::CentreOfMass{}, sample, static_cast<std::uint8_t>(character), 0x80,
                         "10.0.0.2:" + std::to_string(sender));
                }
            }
        }
        follow();
    };
    const auto depth = [this] { return m_session.roster().streams().front().accounting.depth(); };
    streamsFrom(2);
    ASSERT_EQ(m_session.roster().streams().size(), AccountingDepth::kFullStreams);
    EXPECT_EQ(depth(), AccountingDepth()) << "nothing changes up to there";
    streamsFrom(3);
    EXPECT_EQ(depth(), AccountingDepth::of(768));
    streamsFrom(4);
    for (const Stream& stream : m_session.roster().streams()) {
        EXPECT_EQ(stream.accounting.depth(), AccountingDepth::of(m_session.roster().streams().size()));
        EXPECT_EQ(stream.accounting.counts().samples, 3U);
    }
    std::size_t most = 0;
    for (std::size_t streams = 1; streams <= Roll::kMostStreams; ++streams) {
        most = std::max(most, streams * StreamAccounting::mostBytes(AccountingDepth::of(streams)));
    }
    EXPECT_LT(most, std::size_t{380} << 20);
}

TEST_F(MemoryTest, OfIncompleteSamplesIsBoundedWhereStampsStandStill) {
    for (std::uint32_t sample = 1; sample < 300'000; ++sample) {
        const std::uint8_t counter = sample <= 200 ? 0x81 : 0; // there are several in a sample
        send(wire::CentreOfMass{}, sample, static_cast<std::uint8_t>(sample % 200), counter);
    }
    follow();
    EXPECT_LE(bytesOf("accounting"), std::size_t{200} << 20);
    std::uint64_t attributed = 0;
    for (const Stream& stream : m_session.roster().streams()) {
        attributed = std::accumulate(stream.attributed.begin(), stream.attributed.end(), attributed);
    }
    EXPECT_GT(attributed, 200'000U) << "what had to go was judged";
}

} // namespace
} // namespace posewire::model
