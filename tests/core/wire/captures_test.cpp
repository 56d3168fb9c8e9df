// SPDX-License-Identifier: MIT
#include "core/model/body/spaces.h"
#include "core/wire/codec.h"
#include "core/wire/text.h"
#include "tests/support/golden.h"

#include <gtest/gtest.h>

#define SKIP_WITHOUT(bytes)                                                                                  \
    if ((bytes).empty()) {                                                                                   \
        GTEST_SKIP() << "NOT TESTED: the recorded datagrams are not at hand";                                \
    }

namespace posewire::wire {
namespace {

using posewire::test::capture;

template <class Message>
Message messageOf(const std::vector<std::byte>& bytes) {
    const auto datagram = decode(bytes);
    EXPECT_TRUE(datagram);
    EXPECT_TRUE(datagram && datagram->notices.empty());
    const Message* message = datagram ? std::get_if<Message>(&datagram->body) : nullptr;
    EXPECT_NE(message, nullptr);
    return message != nullptr ? *message : Message{};
}

template <std::size_t N>
void expectNear(const std::array<float, N>& values, const std::array<double, N>& expected) {
    for (std::size_t i = 0; i < N; ++i) {
        EXPECT_NEAR(values[i], expected[i], 5.1e-6) << i;
    }
}

TEST(Captures, SurviveDecodingAndEncodingBitForBit) {
    SKIP_WITHOUT(capture("mxtp01.bin"));
    for (const char* file : {"mxtp01.bin", "mxtp02.bin", "mxtp12.bin", "mxtp13.bin"}) {
        const auto datagram = decode(capture(file));
        ASSERT_TRUE(datagram) << file;
        EXPECT_TRUE(datagram->notices.empty()) << file;
        EXPECT_EQ(*encode(*datagram), capture(file)) << file;
    }
}

TEST(Captures, HaveTheHeadersOfOneSample) {
    SKIP_WITHOUT(capture("mxtp01.bin"));
    for (const char* file : {"mxtp01.bin", "mxtp02.bin"}) {
        const auto header = decodeHeader(capture(file));
        ASSERT_TRUE(header) << file;
        EXPECT_EQ(header->sampleCounter, 6681U);
        EXPECT_EQ(header->timeCode, 27837U);
        EXPECT_EQ(header->datagramCounter, 0x80);
        EXPECT_EQ(header->items, 23);
        EXPECT_EQ(header->bodySegments, 23);
    }
}

TEST(Captures, HaveThePelvisWhereItWas) {
    SKIP_WITHOUT(capture("mxtp01.bin"));
    const auto euler = messageOf<PoseEuler>(capture("mxtp01.bin"));
    ASSERT_EQ(euler.segments.size(), 23U);
    EXPECT_EQ(euler.segments[0].id, 1U);
    expectNear(euler.segments[0].position, {41.07322, 104.83481, 6.89773});
    expectNear(euler.segments[0].rotation, {-8.50283, -14.79928, 0.56439});
    const auto pose = messageOf<PoseQuaternion>(capture("mxtp02.bin"));
    ASSERT_EQ(pose.segments.size(), 23U);
    expectNear(pose.segments[0].position, {0.06898, 0.41073, 1.04835});
    expectNear(pose.segments[0].orientation, {0.98898, -0.00468, -0.07288, -0.12880});
}

TEST(Captures, AgreeBetweenEulerAnglesAndQuaternions) {
    SKIP_WITHOUT(capture("mxtp01.bin"));
    const auto euler = messageOf<PoseEuler>(capture("mxtp01.bin"));
    const auto pose = messageOf<PoseQuaternion>(capture("mxtp02.bin"));
    ASSERT_EQ(euler.segments.size(), pose.segments.size());
    for (std::size_t i = 0; i < pose.segments.size(); ++i) {
        EXPECT_EQ(euler.segments[i].id, pose.segments[i].id);
        const auto a = model::poseFromEuler(euler.segments[i]);
        const auto b = model::poseFromQuaternion(pose.segments[i]);
        EXPECT_LE((a.position - b.position).cwiseAbs().maxCoeff(), 1e-6) << "segment " << i + 1;
        const Eigen::Matrix3d difference =
            a.orientation.toRotationMatrix() - b.orientation.toRotationMatrix();
        EXPECT_LE(difference.cwiseAbs().maxCoeff(), 1e-5) << "segment " << i + 1;
    }
}

TEST(Captures, HaveTheMetadataOfTheRecording) {
    SKIP_WITHOUT(capture("mxtp12.bin"));
    const auto metaData = messageOf<MetaData>(capture("mxtp12.bin"));
    EXPECT_TRUE(metaData.hasLengthPrefix);
    EXPECT_EQ(parseTags(metaData.text).tags,
              (std::vector<Tag>{
                  {"color", "e96417"}, {"count", "1"}, {"name", "Factory"}, {"timeOffset", "-3600000"}}));
}

TEST(Captures, HaveANullPoseOf23NamedSegments) {
    SKIP_WITHOUT(capture("mxtp13.bin"));
    const auto bytes = capture("mxtp13.bin");
    const auto nullPose = messageOf<NullPose>(bytes);
    ASSERT_EQ(nullPose.segments.size(), 23U);
    EXPECT_TRUE(nullPose.points.empty());
    EXPECT_EQ(nullPose.segments[0].name, "Pelvis");
    EXPECT_EQ(nullPose.segments[22].name, "LeftToe");
    EXPECT_NEAR(nullPose.segments[0].position[2], 1.05212, 5.1e-6);
    EXPECT_EQ(decodeHeader(bytes)->datagramCounter, 0x00);
    EXPECT_EQ(decodeHeader(bytes)->items, 0);
}

} // namespace
} // namespace posewire::wire
