// SPDX-License-Identifier: MIT
#include "core/model/accounting/packet_digest.h"

#include <gtest/gtest.h>

namespace posewire::model {
namespace {

using namespace std::chrono_literals;

struct Digests : testing::Test {
    PacketDigest send(std::uint32_t sample, std::uint8_t datagramCounter = 0x80, std::uint8_t type = 2) {
        wire::Datagram datagram;
        datagram.header.setType(type);
        datagram.header.sampleCounter = sample;
        datagram.header.datagramCounter = datagramCounter;
        log::Packet packet;
        packet.number = number++;
        packet.stamp = stamp += 4ms;
        return digester.add(packet, &datagram);
    }
    void sendSteady(std::uint32_t from, std::uint32_t to, std::uint32_t step = 1) {
        for (std::uint32_t sample = from; sample < to; sample += step) {
            EXPECT_FALSE(send(sample).isProblem()) << sample;
        }
    }
    PacketDigester digester;
    std::uint64_t number = 0;
    log::Stamp stamp{1s};
};

TEST_F(Digests, OfASteadyStreamShowNoProblem) {
    EXPECT_LT(send(100).deltaS, 0);
    EXPECT_FLOAT_EQ(send(101).deltaS, 0.004F);
    sendSteady(102, 400);
}

TEST_F(Digests, CountWhatIsMissingInTheSendersOwnStep) {
    sendSteady(0, 80, 4);
    EXPECT_EQ(send(92).gap, 3U);
    EXPECT_EQ(send(96).gap, 0U);
}

TEST_F(Digests, KnowDuplicatesAndReordering) {
    sendSteady(0, 20);
    EXPECT_TRUE(send(19).isDuplicate);
    EXPECT_EQ(send(21).gap, 1U);
    const PacketDigest late = send(20);
    EXPECT_TRUE(late.isReordered);
    EXPECT_EQ(late.gap, 0U);
    EXPECT_FALSE(send(22).isProblem());
}

TEST_F(Digests, DoNotGuessWhatAJumpBackIs) {
    sendSteady(50'000, 50'020);
    const PacketDigest again = send(7);
    EXPECT_TRUE(again.isInDoubt);
    EXPECT_FALSE(again.isRestart) << "what comes next shows it";
    EXPECT_EQ(again.gap, 0U);
    EXPECT_FALSE(send(8).isProblem());
}

TEST_F(Digests, PassTheWrapOfTheCounter) {
    for (std::uint32_t sample = UINT32_MAX - 20; sample != 20; ++sample) {
        EXPECT_FALSE(send(sample).isProblem()) << sample;
    }
}

TEST_F(Digests, AllowTheRepetitionOfScaleAndMetaData) {
    send(0, 0x80, 12);
    EXPECT_FALSE(send(0, 0x80, 12).isProblem());
}

TEST_F(Digests, TellKindsApart) {
    const auto kind = [&](std::string_view text, bool isSkipped = false) {
        log::Packet packet;
        packet.bytes = std::as_bytes(std::span(text));
        packet.flags.skipped = isSkipped;
        return digester.add(packet, nullptr).kind;
    };
    EXPECT_EQ(kind("MXTP02"), PacketKind::Malformed);
    EXPECT_EQ(kind("OSC!/x"), PacketKind::Foreign);
    EXPECT_EQ(kind("MXTP02", true), PacketKind::Skipped);
}

TEST(PacketDigests, FindProblemsInBothDirectionsAndForgetWithTheLog) {
    PacketDigests digests;
    for (std::uint64_t number = 10; number < 30'000; ++number) {
        PacketDigest digest;
        digest.gap = number == 11 || number == 9'000 || number == 29'000 ? 1 : 0;
        digests.append(number, digest);
    }
    EXPECT_EQ(digests.nextProblem(11), 9'000U);
    EXPECT_EQ(digests.nextProblem(9'000), 29'000U);
    EXPECT_EQ(digests.nextProblem(29'000), std::nullopt);
    EXPECT_EQ(digests.previousProblem(9'000), 11U);
    EXPECT_EQ(digests.previousProblem(11), std::nullopt);
    digests.dropBefore(20'000);
    EXPECT_EQ(digests.find(19'999), nullptr);
    EXPECT_NE(digests.find(20'000), nullptr);
    EXPECT_EQ(digests.previousProblem(29'000), std::nullopt);
    EXPECT_EQ(digests.end(), 30'000U);
}

} // namespace
} // namespace posewire::model
