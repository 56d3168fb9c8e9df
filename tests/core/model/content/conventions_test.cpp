// SPDX-License-Identifier: MIT
#include "tests/core/model/content/content_fixture.h"

#include "core/model/body/spaces.h"

/// Conventions are told by what joints there are, and named.
namespace posewire::model {
namespace {

struct Case {
    const char* name;
    void (*change)(wire::SegmentQuaternion&);
    words::Kind looks;
};
void PrintTo(const Case& one, std::ostream* out) {
    *out << one.name;
}

class Conventions : public ContentTest, public testing::WithParamInterface<std::tuple<Case, std::string>> {};

TEST_P(Conventions, AreNamedAndNeverGood) {
    const auto& [one, motion] = GetParam();
    m_settings.motion = motion;
    perform(2, ofEach(one.change));
    ASSERT_EQ(of(ContentFault::Convention).size(), 1U) << testing::PrintToString(told());
    const Incident found = of(ContentFault::Convention).front();
    EXPECT_EQ(found.detail.kind, words::Kind::ConventionLooks);
    EXPECT_EQ(partOf(found.detail, "looks").kind, one.looks);
    EXPECT_EQ(verdict().state, TakeVerdict::State::Bad);
    perform(1);
    EXPECT_FALSE(of(ContentFault::Convention).front().isCurrent);
}

void sendXyzw(wire::SegmentQuaternion& one) {
    const auto q = one.orientation;
    one.orientation = {q[1], q[2], q[3], q[0]};
}
void mirrorAll(wire::SegmentQuaternion& one) {
    const auto q = one.orientation;
    one.position[1] = -one.position[1];
    one.orientation = {q[0], -q[1], q[2], -q[3]};
}
void mirrorPlaces(wire::SegmentQuaternion& one) {
    one.position[1] = -one.position[1];
}
void invert(wire::SegmentQuaternion& one) {
    const auto q = one.orientation;
    one.orientation = {q[0], -q[1], -q[2], -q[3]};
}
void sendUnity(wire::SegmentQuaternion& one) {
    one.position = toFloats(unityFromZUp(toVector(one.position)));
    one.orientation = toFloats(unityFromZUp(toQuaternion(one.orientation)));
}
/// Exchanges the IDs of the arms and of the legs.
void swapSides(wire::SegmentQuaternion& one) {
    one.id = one.id <= kBodySegments ? static_cast<std::uint32_t>(mirrored(static_cast<int>(one.id) - 1) + 1)
                                     : one.id;
}

INSTANTIATE_TEST_SUITE_P(
    All, Conventions,
    testing::Combine(testing::Values(Case{"xyzw", sendXyzw, words::Kind::QuaternionXyzw},
                                     Case{"mirrored", mirrorAll, words::Kind::AllMirrored},
                                     Case{"places", mirrorPlaces, words::Kind::PlacesMirrored},
                                     Case{"inverse", invert, words::Kind::QuaternionInverse},
                                     Case{"unity", sendUnity, words::Kind::UnityAxes},
                                     Case{"sides", swapSides, words::Kind::AllMirrored}),
                     testing::Values("walk", "wave", "squat")));

TEST_F(ContentTest, WhatFitsNoConventionIsSaidToo) {
    perform(2, ofEach([](auto& segment) {
                segment.orientation = {0.5F, segment.id % 2 == 0 ? 0.5F : -0.5F, 0.5F, -0.5F};
            }));
    EXPECT_EQ(only(ContentFault::Convention).detail.kind, words::Kind::ConventionUnknown);
}

TEST_F(ContentTest, YUpIsAllowed) {
    perform(3, ofEach([](auto& segment) {
                segment.position = toFloats(yUpFromZUp(toVector(segment.position)));
                segment.orientation = toFloats(yUpFromZUp(toQuaternion(segment.orientation)));
            }));
    EXPECT_TRUE(told().empty()) << testing::PrintToString(told());
}

} // namespace
} // namespace posewire::model
