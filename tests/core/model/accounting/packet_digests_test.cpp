// SPDX-License-Identifier: MIT
#include "core/model/accounting/packet_digest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace posewire::model {
namespace {

PacketDigest problem() {
    PacketDigest digest;
    digest.gap = 1;
    return digest;
}

/// What a verdict that took its time says of a packet.
Verdict verdictOn(std::uint64_t packet, std::uint32_t gap) {
    Verdict verdict;
    verdict.packet = packet;
    verdict.gap = gap;
    return verdict;
}

TEST(PacketDigests, WalkOverProblemsAsAPlainListDoes) {
    std::mt19937 random(17);
    for (const std::uint32_t rarity : {3U, 500U, 6'000U}) {
        PacketDigests digests;
        std::vector<bool> isProblem(15'000);
        constexpr std::uint64_t kFirst = 777; // the log began to be followed late
        for (std::size_t i = 0; i < isProblem.size(); ++i) {
            isProblem[i] = random() % rarity == 0;
            digests.append(kFirst + i, isProblem[i] ? problem() : PacketDigest{});
        }
        digests.dropBefore(kFirst + 5'000);
        EXPECT_EQ(digests.begin(), kFirst + 5'000);
        for (std::uint64_t from = 4'900; from < isProblem.size() + 10; from += 1 + random() % 200) {
            std::optional<std::uint64_t> next;
            for (std::uint64_t i = std::max<std::uint64_t>(from + 1, 5'000); i < isProblem.size() && !next;
                 ++i) {
                next = isProblem[i] ? std::optional(kFirst + i) : std::nullopt;
            }
            std::optional<std::uint64_t> previous;
            for (std::uint64_t i = std::min<std::uint64_t>(from, isProblem.size()); i > 5'000 && !previous;
                 --i) {
                previous = isProblem[i - 1] ? std::optional(kFirst + i - 1) : std::nullopt;
            }
            ASSERT_EQ(digests.nextProblem(kFirst + from), next) << from;
            ASSERT_EQ(digests.previousProblem(kFirst + from), previous) << from;
        }
    }
}

TEST(PacketDigests, HaveEmptyOnesForNumbersThatAreLeftOut) {
    PacketDigests digests;
    digests.append(10, problem());
    digests.append(9'000, problem()); // what lies between was dropped before it was looked at
    EXPECT_EQ(digests.find(9), nullptr);
    ASSERT_NE(digests.find(11), nullptr);
    EXPECT_FALSE(digests.find(11)->isProblem());
    EXPECT_EQ(digests.nextProblem(10), 9'000U);
    EXPECT_EQ(digests.previousProblem(9'000), 10U);
    EXPECT_EQ(digests.find(9'001), nullptr);
}

TEST(PacketDigests, AreCorrectedByVerdictsThatComeLater) {
    PacketDigests digests;
    for (std::uint64_t number = 0; number < 10'000; ++number) {
        digests.append(number, {});
    }
    digests.amend(verdictOn(4'100, 3));
    EXPECT_EQ(digests.find(4'100)->gap, 3U);
    EXPECT_EQ(digests.nextProblem(0), 4'100U);
    digests.amend(verdictOn(4'100, 5));
    EXPECT_EQ(digests.nextProblem(4'100), std::nullopt);
    digests.amend(verdictOn(4'100, 0));
    EXPECT_EQ(digests.nextProblem(0), std::nullopt) << "it is none any more";
    digests.dropBefore(5'000);
    digests.amend(verdictOn(4'100, 7));  // the log has dropped it
    digests.amend(verdictOn(20'000, 7)); // not there yet
    EXPECT_EQ(digests.nextProblem(0), std::nullopt);
}

TEST(PacketDigests, GiveExcerptsThatStayAsTheyWere) {
    PacketDigests digests;
    for (std::uint64_t number = 0; number < 6'000; ++number) {
        digests.append(number, number % 1'000 == 0 ? problem() : PacketDigest{});
    }
    const auto excerpt = digests.excerpt(4'090, 6'000);
    digests.amend(verdictOn(4'092, 9));
    digests.amend(verdictOn(5'000, 0));
    for (std::uint64_t number = 6'000; number < 20'000; ++number) {
        digests.append(number, problem());
    }
    digests.dropBefore(19'000);
    EXPECT_EQ(excerpt.begin(), 4'090U);
    EXPECT_EQ(excerpt.end(), 6'000U);
    for (std::uint64_t number = excerpt.begin(); number < excerpt.end(); ++number) {
        ASSERT_EQ(excerpt.at(number).gap, number % 1'000 == 0 ? 1U : 0U) << number;
    }
}

TEST(PacketDigests, GiveAnEmptyExcerptWhereThereIsNothing) {
    PacketDigests digests;
    EXPECT_EQ(digests.excerpt(0, digests.end()).begin(), digests.excerpt(0, digests.end()).end());
    for (std::uint64_t number = 100; number < 100 + 4'096; ++number) {
        digests.append(number, problem());
    }
    EXPECT_EQ(digests.excerpt(10'000, 20'000).begin(), 4'196U);
    EXPECT_EQ(digests.excerpt(10'000, 20'000).end(), 4'196U);
    const auto all = digests.excerpt(0, digests.end()); // a block that is full is shared
    EXPECT_EQ(all.begin(), 100U);
    EXPECT_EQ(all.end(), 4'196U);
    EXPECT_EQ(all.at(4'195).gap, 1U);
}

/// A packet of that many bytes, with their text.
log::Packet packetOf(std::string_view text) {
    log::Packet packet;
    packet.bytes = std::as_bytes(std::span(text.data(), text.size()));
    return packet;
}

TEST(DigestOfPacket, KnowsMalformedForeignAndSkippedOnes) {
    EXPECT_EQ(digestOf(packetOf("{\"type\":1}"), nullptr).kind, PacketKind::Foreign);
    EXPECT_EQ(digestOf(packetOf(""), nullptr).kind, PacketKind::Foreign);
    EXPECT_EQ(digestOf(packetOf("MXT"), nullptr).kind, PacketKind::Foreign);
    const PacketDigest cut = digestOf(packetOf("MXTP02"), nullptr);
    EXPECT_EQ(cut.kind, PacketKind::Malformed);
    EXPECT_EQ(cut.type, 0) << "its header cannot be read";
    log::Packet skipped = packetOf("MXTP02");
    skipped.flags.skipped = true;
    EXPECT_EQ(digestOf(skipped, nullptr).kind, PacketKind::Skipped);
    for (const PacketDigest& digest : {cut, digestOf(skipped, nullptr)}) {
        EXPECT_TRUE(digest.isProblem());
    }
}

TEST(DigestOfPacket, KnowsTypeAndCharacterOfWhatHasAHeader) {
    std::string text = "MXTP21";
    text.resize(24); // a header alone: its body is missing
    text[16] = 3;
    const PacketDigest digest = digestOf(packetOf(text), nullptr);
    EXPECT_EQ(digest.kind, PacketKind::Malformed);
    EXPECT_EQ(digest.type, 21);
    EXPECT_EQ(digest.character, 3);
}

TEST(DigestOfPacket, TellsNoticesTruncationAndDrops) {
    const wire::Datagram plain;
    EXPECT_FALSE(digestOf(packetOf(""), &plain).isProblem());
    wire::Datagram odd;
    odd.notices.emplace_back();
    EXPECT_TRUE(digestOf(packetOf(""), &odd).hasNotices);
    log::Packet packet = packetOf("");
    packet.flags.truncated = true;
    EXPECT_TRUE(digestOf(packet, &plain).isTruncated);
    EXPECT_TRUE(digestOf(packet, &plain).isProblem());
    packet.flags.truncated = false;
    packet.kernelDropsBefore = 1;
    EXPECT_TRUE(digestOf(packet, &plain).followsDrops);
    EXPECT_TRUE(digestOf(packet, &plain).isProblem());
}

TEST(PacketDigester, ComparesNoMoreStreamsThanItKeeps) {
    PacketDigester digester;
    wire::Datagram datagram;
    datagram.header.setType(2);
    log::Packet packet;
    const auto add = [&](std::size_t stream) {
        packet.sender = static_cast<log::SenderId>(stream);
        ++packet.number;
        packet.stamp += std::chrono::milliseconds(1);
        return digester.add(packet, &datagram);
    };
    for (std::size_t stream = 0; stream <= log::StreamIndex::kStreamLimit; ++stream) {
        add(stream);
    }
    EXPECT_TRUE(add(log::StreamIndex::kStreamLimit - 1).isDuplicate);
    EXPECT_FALSE(add(log::StreamIndex::kStreamLimit).isDuplicate);
    EXPECT_LT(add(log::StreamIndex::kStreamLimit).deltaS, 0) << "each is like the first of its stream";
}

} // namespace
} // namespace posewire::model
