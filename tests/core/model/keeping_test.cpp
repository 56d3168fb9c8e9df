// SPDX-License-Identifier: MIT
#include "core/model/body/null_pose.h"
#include "core/model/session/metadata.h"
#include "core/wire/messages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

namespace posewire::model {
namespace {

using namespace std::chrono_literals;

constexpr log::Stamp at(log::Duration time) {
    return log::Stamp(time);
}

template <class Holder>
std::size_t bytesOf(const std::vector<Holder>& holders) {
    std::size_t bytes = 0;
    for (const Holder& holder : holders) {
        bytes += holder.memoryBytes();
    }
    return bytes;
}

template <class Holder>
std::vector<Holder*> pointersTo(std::vector<Holder>& holders) {
    std::vector<Holder*> pointers;
    std::ranges::transform(holders, std::back_inserter(pointers), [](Holder& each) { return &each; });
    return pointers;
}

/// Names of 60 KB that are all different.
std::string longText(std::uint64_t number) {
    return std::to_string(number) + std::string(60'000, 'x');
}

TEST(Keeping, HoldsMetadataOfAllCharactersWithinItsBudget) {
    constexpr std::size_t kBudget = std::size_t{1} << 20;
    Keeping keeping(kBudget);
    std::vector<Metadata> all(64);
    for (std::uint64_t i = 0; i < 6'000; ++i) {
        Metadata& metadata = all[i % all.size()];
        const std::size_t before = metadata.memoryBytes();
        const std::string tag = "tag" + std::to_string(i / all.size());
        metadata.add({true, tag + ":" + longText(i) + "\nname:" + std::to_string(i) + "\n"}, i, at(i * 1ms));
        if (keeping.grew(before, metadata.memoryBytes())) {
            keeping.keepWithin(pointersTo(all));
        }
        if (i % 500 == 0) {
            EXPECT_LE(bytesOf(all), kBudget) << i;
        }
    }
    for (std::uint64_t i = 0; i < all.size(); ++i) {
        EXPECT_FALSE(all[i].value("name", 6'000).isEmpty()) << "what is known goes last";
    }
    EXPECT_GT(all[0].droppedTags(), 0U);
}

TEST(Keeping, GivesUpChangesBeforeWhatHolds) {
    Metadata metadata;
    for (std::uint64_t i = 0; i < 10; ++i) {
        metadata.add({true, "name:" + std::to_string(i) + "\nshoeSize:42\n"}, i, at(i * 1s));
    }
    metadata.add({true, "note:" + longText(0) + "\n"}, 10, at(10s));
    for (int i = 0; i < 9; ++i) {
        metadata.dropOldest();
    }
    EXPECT_EQ(metadata.find("name")->values.size(), 1U);
    EXPECT_EQ(metadata.find("name")->dropped, 9U);
    EXPECT_EQ(metadata.value("note", 10).exact(), longText(0));
    EXPECT_GT(metadata.dropOldest(), 60'000U) << "then the bytes of long texts";
    EXPECT_EQ(metadata.value("note", 10), longText(0)) << "which are still recognized";
    metadata.dropOldest();
    EXPECT_EQ(metadata.find("shoeSize"), nullptr) << "then what nobody knows, oldest first";
    metadata.dropOldest();
    EXPECT_NE(metadata.find("name"), nullptr);
    metadata.dropOldest();
    EXPECT_TRUE(metadata.tags().empty());
    EXPECT_FALSE(metadata.oldest());
}

wire::NullPose bodyOf(float height) {
    wire::NullPose part;
    for (int i = 0; i < 23; ++i) {
        part.segments.push_back({"Segment " + std::to_string(i), {0, 0, height}});
    }
    return part;
}

TEST(Keeping, HoldsNullPosesOfAllCharactersWithinItsBudget) {
    constexpr std::size_t kBudget = std::size_t{1} << 20;
    Keeping keeping(kBudget);
    std::vector<NullPoseHistory> all(64);
    for (std::uint64_t i = 0; i < 16'000; ++i) {
        NullPoseHistory& history = all[i % all.size()];
        const std::size_t before = history.memoryBytes();
        history.add(bodyOf(static_cast<float>(i)), 0x80, i, at(i * 100ms));
        if (keeping.grew(before, history.memoryBytes())) {
            keeping.keepWithin(pointersTo(all));
        }
        if (i % 500 == 0) {
            EXPECT_LE(bytesOf(all), kBudget) << i;
        }
    }
    for (const NullPoseHistory& history : all) {
        ASSERT_NE(history.at(16'000), nullptr) << "the body of now goes last";
        EXPECT_GT(history.dropped(), 0U);
    }
}

TEST(Keeping, BeginsAgainAfterEverythingWasGivenUp) {
    NullPoseHistory history;
    history.add(bodyOf(1), 0x80, 1, at(1s));
    while (history.oldest()) {
        EXPECT_GT(history.dropOldest(), 0U);
    }
    EXPECT_EQ(history.at(1), nullptr);
    EXPECT_EQ(history.record(1).newest, nullptr);
    history.add(bodyOf(1), 0x80, 2, at(6s));
    ASSERT_NE(history.at(2), nullptr);
    EXPECT_EQ(history.at(2)->segments.size(), 23U);
    EXPECT_TRUE(history.record(2).newest->isComplete());
}

TEST(NullPoseMemory, TakesTheSameBodyOnce) {
    NullPoseHistory history;
    history.add(bodyOf(1), 0x80, 0, at(0s));
    const std::size_t once = history.memoryBytes();
    for (std::uint64_t i = 1; i < 1'000; ++i) {
        history.add(bodyOf(1), 0x80, i, at(i * 5s));
    }
    EXPECT_LT(history.memoryBytes(), once + NullPoseHistory::kMostMessages * 256);
}

TEST(NullPoseMemory, LeavesOutWhatNoBodyHas) {
    NullPoseHistory history;
    wire::NullPose part = bodyOf(1);
    part.segments[3].name = longText(3);
    for (std::uint16_t i = 0; i < 3'000; ++i) {
        part.points.push_back({1, i, "p" + std::to_string(i), 0, {0, 0, 0}});
    }
    for (std::uint8_t index = 0; index < 127; ++index) {
        part.segments.resize(index == 0 ? 23 : 0);
        history.add(part, index, index, at(index * 1ms));
    }
    const NullPose& pose = *history.at(200);
    EXPECT_EQ(pose.segments.size(), 23U);
    EXPECT_EQ(pose.segments[3].name, longText(3));
    EXPECT_LT(pose.points.size(), 4'000U);
    EXPECT_EQ(pose.points.size() + pose.leftOut, 127U * 3'000U);
    EXPECT_LT(history.memoryBytes(), 5 * NullPose::kMostBytes);
}

} // namespace
} // namespace posewire::model
