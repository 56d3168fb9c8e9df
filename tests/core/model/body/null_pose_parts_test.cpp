// SPDX-License-Identifier: MIT
#include "core/model/body/null_pose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <vector>

/// A scale message that comes in several datagrams: out of order, twice, damaged, never.
namespace posewire::model {
namespace {

using namespace std::chrono_literals;

constexpr log::Stamp partAt(log::Duration time) {
    return log::Stamp(time);
}

/// A message as real senders divide it: all segments first, then points; the last may have none.
std::vector<wire::NullPose> messageOf(float height, std::size_t parts) {
    std::vector<wire::NullPose> message(parts);
    for (int i = 0; i < 23; ++i) {
        message[0].segments.push_back(
            {"Segment " + std::to_string(i), {0, 0, height + 0.05F * static_cast<float>(i)}});
    }
    for (std::size_t part = 1; part < parts; ++part) {
        for (std::uint16_t point = 1; point <= 5; ++point) {
            message[part].points.push_back(
                {static_cast<std::uint16_t>(part), point, "p" + std::to_string(point), 0, {0.1F, 0, height}});
        }
    }
    return message;
}

std::uint8_t counterOf(std::size_t part, std::size_t parts) {
    return static_cast<std::uint8_t>(part | (part + 1 == parts ? 0x80U : 0U));
}

std::vector<int> pointSegments(const NullPose& pose) {
    std::vector<int> segments;
    for (const NullPose::Point& point : pose.points) {
        segments.push_back(point.segment);
    }
    return segments;
}

TEST(NullPoseParts, MakeTheSameBodyInEveryOrder) {
    const auto message = messageOf(1, 5);
    std::vector<std::size_t> order{0, 1, 2, 3, 4};
    NullPose expected;
    do {
        NullPoseAssembler assembler;
        for (std::size_t i = 0; i < order.size(); ++i) {
            assembler.add(message[order[i]], counterOf(order[i], 5), i, partAt(i * 1ms));
            EXPECT_EQ(assembler.arriving().partsReceived, i + 1);
            EXPECT_EQ(assembler.arriving().isComplete(), i == 4);
        }
        const NullPose* pose = assembler.newest();
        ASSERT_NE(pose, nullptr);
        ASSERT_TRUE(pose->isComplete());
        EXPECT_EQ(pose->message, 1U);
        EXPECT_EQ(pose->segments.size(), 23U);
        EXPECT_TRUE(pose->missingParts.empty());
        const auto segments = pointSegments(*pose);
        EXPECT_EQ(segments.size(), 20U);
        EXPECT_TRUE(std::ranges::is_sorted(segments)) << "points are in the order of their parts";
    } while (std::ranges::next_permutation(order).found);
}

TEST(NullPoseParts, ThatOvertakeTheFirstOneAreOfItsMessageWithinAQuarterOfASecond) {
    const auto message = messageOf(1, 3);
    for (const log::Duration apart : {250ms, 251ms}) {
        NullPoseAssembler assembler;
        assembler.add(message[2], counterOf(2, 3), 0, partAt(1s));
        assembler.add(message[0], counterOf(0, 3), 1, partAt(1s) + apart);
        EXPECT_EQ(assembler.arriving().message, apart == 250ms ? 1U : 2U);
        EXPECT_EQ(assembler.arriving().partsReceived, apart == 250ms ? 2U : 1U);
        assembler.add(message[1], counterOf(1, 3), 2, partAt(1s) + apart);
        EXPECT_EQ(assembler.arriving().isComplete(), apart == 250ms);
    }
}

TEST(NullPoseParts, ThatTheNetworkRepeatsChangeNothing) {
    std::mt19937 random(9);
    const auto message = messageOf(1, 6);
    for (int round = 0; round < 50; ++round) {
        std::vector<std::size_t> order;
        for (std::size_t part = 0; part < 6; ++part) {
            order.insert(order.end(), 1 + random() % 3, part);
        }
        // The first part begins a message where it follows others, so it stays in front.
        std::shuffle(std::ranges::find_if(order, [](std::size_t part) { return part != 0; }), order.end(),
                     random);
        NullPoseAssembler assembler;
        for (std::size_t i = 0; i < order.size(); ++i) {
            assembler.add(message[order[i]], counterOf(order[i], 6), i, partAt(1s + i * 1ms));
        }
        EXPECT_EQ(assembler.arriving().message, 1U);
        EXPECT_EQ(assembler.arriving().partsReceived, 6U);
        ASSERT_NE(assembler.newest(), nullptr);
        EXPECT_TRUE(assembler.newest()->isComplete());
        EXPECT_EQ(assembler.newest()->points.size(), 25U);
    }
}

TEST(NullPoseParts, ThatAreMissingAreListed) {
    const auto message = messageOf(1, 8);
    NullPoseAssembler assembler;
    for (const std::size_t part : {0U, 1U, 4U, 7U}) {
        assembler.add(message[part], counterOf(part, 8), part, partAt(1s));
    }
    EXPECT_EQ(assembler.newest()->partsExpected, 8U);
    EXPECT_EQ(assembler.newest()->partsReceived, 4U);
    EXPECT_EQ(assembler.newest()->missingParts, (std::vector<unsigned>{2, 3, 5, 6}));
    assembler.add(message[5], counterOf(5, 8), 8, partAt(1s));
    EXPECT_EQ(assembler.newest()->missingParts, (std::vector<unsigned>{2, 3, 6}));
}

TEST(NullPoseParts, OfALostEndLeaveTheNumberOpen) {
    const auto message = messageOf(1, 3);
    NullPoseAssembler assembler;
    assembler.add(message[0], counterOf(0, 3), 0, partAt(1s));
    assembler.add(message[1], counterOf(1, 3), 1, partAt(1s));
    EXPECT_EQ(assembler.newest()->partsExpected, 0U);
    EXPECT_FALSE(assembler.newest()->isComplete());
    EXPECT_TRUE(assembler.newest()->missingParts.empty()) << "none below the last one that is known of";
}

TEST(NullPoseParts, MayBeAsManyAsTheIndexCanTellApart) {
    const auto message = messageOf(1, 128);
    NullPoseAssembler assembler;
    for (std::size_t part = 0; part < 128; ++part) {
        assembler.add(message[part], counterOf(part, 128), part, partAt(1s));
    }
    EXPECT_TRUE(assembler.newest()->isComplete());
    EXPECT_EQ(assembler.newest()->points.size(), 127U * 5);
}

TEST(NullPoseParts, OfAnotherPerformerAreUsedAtOnce) {
    const auto first = messageOf(1, 3);
    const auto second = messageOf(1.2F, 3);
    NullPoseAssembler assembler;
    for (std::size_t part = 0; part < 3; ++part) {
        assembler.add(first[part], counterOf(part, 3), part, partAt(1s));
    }
    assembler.add(second[0], counterOf(0, 3), 3, partAt(6s));
    EXPECT_FLOAT_EQ(static_cast<float>(assembler.newest()->segments[0].position.z()), 1.2F);
    EXPECT_FALSE(assembler.newest()->isComplete());
    EXPECT_EQ(assembler.newest()->message, 2U);
}

TEST(NullPoseParts, OfTheSameBodyLeaveTheWholeMessageInUseUntilTheyAreAllThere) {
    const auto message = messageOf(1, 3);
    NullPoseAssembler assembler;
    for (std::size_t part = 0; part < 3; ++part) {
        assembler.add(message[part], counterOf(part, 3), part, partAt(1s));
    }
    assembler.add(message[0], counterOf(0, 3), 3, partAt(6s));
    EXPECT_EQ(assembler.arriving().message, 2U);
    EXPECT_EQ(assembler.newest()->message, 1U);
    EXPECT_EQ(assembler.newest()->points.size(), 10U) << "no point is taken away while they come again";
    assembler.add(message[1], counterOf(1, 3), 4, partAt(6s));
    assembler.add(message[2], counterOf(2, 3), 5, partAt(6s));
    EXPECT_EQ(assembler.newest()->message, 2U);
}

TEST(NullPoseParts, WithPositionsThatAreNoNumbersAreKeptAsSent) {
    auto message = messageOf(1, 2);
    message[0].segments[3].position[1] = std::numeric_limits<float>::quiet_NaN();
    NullPoseAssembler assembler;
    for (int round = 0; round < 3; ++round) {
        const log::Stamp stamp = partAt(1s + round * 5s);
        assembler.add(message[0], counterOf(0, 2), 0, stamp);
        assembler.add(message[1], counterOf(1, 2), 1, stamp);
        ASSERT_NE(assembler.newest(), nullptr);
        EXPECT_TRUE(assembler.newest()->isComplete());
        EXPECT_EQ(assembler.newest()->message, static_cast<std::uint64_t>(round + 1));
        EXPECT_FALSE(assembler.newest()->segments[3].position.allFinite());
    }
}

/// Whether a history takes the second of two whole messages for another body.
bool isChange(const std::vector<wire::NullPose>& first, const std::vector<wire::NullPose>& second) {
    NullPoseHistory history;
    std::uint64_t packet = 0;
    log::Stamp stamp = partAt(1s);
    for (const auto* message : {&first, &second}) {
        for (std::size_t part = 0; part < message->size(); ++part) {
            history.add((*message)[part], counterOf(part, message->size()), packet++, stamp);
        }
        stamp += 5s;
    }
    const NullPoseRecord record = history.record(packet);
    EXPECT_EQ(record.messages, 2U);
    EXPECT_EQ(record.changed, record.before == nullptr ? partAt(1s) : partAt(6s));
    return record.before != nullptr;
}

TEST(DifferentBody, IsOneWithOtherSegmentsOrPoints) {
    const auto plain = messageOf(1, 3);
    EXPECT_FALSE(isChange(plain, plain));
    auto other = plain;
    other[2].points[4].position[0] += 0.001F;
    EXPECT_TRUE(isChange(plain, other));
    other = plain;
    other[1].points[0].name = "elsewhere";
    EXPECT_TRUE(isChange(plain, other));
    other = plain;
    other[1].points[0].flags = 1;
    EXPECT_TRUE(isChange(plain, other));
    other = plain;
    other[0].segments.pop_back();
    EXPECT_TRUE(isChange(plain, other));
    other = plain;
    other[0].segments[22].name = "Tail";
    EXPECT_TRUE(isChange(plain, other));
    other = plain;
    other[2].points.clear(); // the points of one message alone: parts get lost
    EXPECT_FALSE(isChange(plain, other));
    EXPECT_FALSE(isChange(other, plain));
}

} // namespace
} // namespace posewire::model
