// SPDX-License-Identifier: MIT
#include "core/performer/performer.h"

#include "core/performer/motion.h"

#include "core/model/body/points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace posewire::performer {
namespace {

using Bytes = std::vector<std::byte>;

Bytes encoded(const std::vector<wire::Datagram>& datagrams) {
    Bytes all;
    for (const wire::Datagram& datagram : datagrams) {
        const auto bytes = wire::encode(datagram);
        EXPECT_TRUE(bytes.has_value());
        all.insert(all.end(), bytes->begin(), bytes->end());
    }
    return all;
}

PerformerSettings settingsOf(Revision revision, std::vector<std::uint8_t> types = {}) {
    PerformerSettings settings;
    settings.revision = revision;
    settings.types = std::move(types);
    return settings;
}

std::multiset<int> typesIn(const std::vector<wire::Datagram>& datagrams) {
    std::multiset<int> types;
    for (const wire::Datagram& datagram : datagrams) {
        types.insert(datagram.header.type());
    }
    return types;
}

const wire::Datagram* firstOf(const std::vector<wire::Datagram>& datagrams, int type) {
    const auto found =
        std::ranges::find_if(datagrams, [&](const auto& d) { return d.header.type() == type; });
    return found == datagrams.end() ? nullptr : &*found;
}

TEST(Performer, GivesTheSameBytesForTheSameSeed) {
    Performer first(settingsOf(Revision::N));
    Performer second(settingsOf(Revision::N));
    for (std::uint64_t frame = 0; frame < 300; ++frame) {
        ASSERT_EQ(encoded(first.frame(frame)), encoded(second.frame(frame))) << "frame " << frame;
    }
}

TEST(Performer, GivesOtherBytesForAnotherSeed) {
    PerformerSettings settings = settingsOf(Revision::N, {2});
    Performer first(settings);
    settings.seed = 2;
    Performer second(settings);
    EXPECT_NE(encoded(first.frame(10)), encoded(second.frame(10)));
}

TEST(Performer, GivesAFrameWhateverWasAskedForBefore) {
    Performer inOrder(settingsOf(Revision::N));
    Bytes expected;
    for (std::uint64_t frame = 0; frame <= 50; ++frame) {
        expected = encoded(inOrder.frame(frame));
    }
    Performer jumping(settingsOf(Revision::N));
    jumping.frame(1'000'000);
    jumping.frame(48);
    EXPECT_EQ(encoded(jumping.frame(50)), expected);
    jumping.frame(51);
    EXPECT_EQ(encoded(jumping.frame(50)), expected);
}

TEST(Performer, DecodesWithoutANoticeInEveryRevision) {
    for (const Revision revision : {Revision::E, Revision::J, Revision::K, Revision::N}) {
        PerformerSettings settings = settingsOf(revision);
        settings.props = 2;
        settings.fingers = true;
        Performer performer(settings);
        for (std::uint64_t frame = 0; frame < 3; ++frame) {
            for (const wire::Datagram& datagram : performer.frame(frame)) {
                const auto bytes = wire::encode(datagram);
                ASSERT_TRUE(bytes.has_value());
                const auto back = wire::decode(*bytes);
                ASSERT_TRUE(back.has_value()) << "type " << int(datagram.header.type());
                EXPECT_EQ(back->header, datagram.header);
                EXPECT_EQ(back->body, datagram.body);
                EXPECT_TRUE(back->notices.empty()) << "type " << int(datagram.header.type());
            }
        }
    }
}

TEST(Performer, SendsEveryTypeOfRevisionNForEveryCharacter) {
    PerformerSettings settings = settingsOf(Revision::N);
    settings.characters = 3;
    Performer performer(settings);
    const auto types = typesIn(performer.frame(0));
    for (const int type : {1, 2, 3, 5, 12, 20, 21, 22, 23, 24, 25}) {
        EXPECT_EQ(types.count(type), 3U) << type;
    }
    EXPECT_EQ(types.count(13), 3U * 6U);
    EXPECT_EQ(types.count(10) + types.count(11) + types.count(4), 0U);
}

TEST(Performer, SendsOnlyWhatWasAskedFor) {
    Performer performer(settingsOf(Revision::N, {2, 12}));
    EXPECT_EQ(typesIn(performer.frame(0)), (std::multiset<int>{2, 2, 12, 12}));
    EXPECT_EQ(typesIn(performer.frame(1)), (std::multiset<int>{2, 2}));
    Performer deprecated(settingsOf(Revision::N, {4, 10, 11}));
    EXPECT_EQ(typesIn(deprecated.frame(0)), (std::multiset<int>{4, 4, 10, 10, 11, 11}));
}

TEST(Performer, SharesSampleCounterAndTimeCodeWithinAFrame) {
    PerformerSettings settings = settingsOf(Revision::N);
    settings.firstSample = 5000;
    settings.startTimeOfDayMs = 86'399'900;
    Performer performer(settings);
    for (const std::uint64_t frame :
         {std::uint64_t{0}, std::uint64_t{12}, std::uint64_t{24}, std::uint64_t{48}}) {
        const auto expectedTime = (86'399'900 + frame * 1000 / 240) % 86'400'000;
        for (const wire::Datagram& datagram : performer.frame(frame)) {
            const bool isInformation = datagram.header.type() == 12 || datagram.header.type() == 13;
            EXPECT_EQ(datagram.header.sampleCounter, isInformation ? 0U : 5000U + frame);
            EXPECT_EQ(datagram.header.timeCode, isInformation ? 0U : expectedTime);
        }
    }
}

TEST(Performer, TellsTheTimeOfDayOfTheHeaderInType25) {
    PerformerSettings settings = settingsOf(Revision::N, {25});
    settings.startTimeOfDayMs = 36'000'000;
    Performer performer(settings);
    const auto text = [&](std::uint64_t frame) {
        return std::string(std::get<wire::TimeCode>(performer.frame(frame).front().body).view());
    };
    EXPECT_EQ(text(0), "10:00:00.000");
    EXPECT_EQ(text(1), "10:00:00.004");
    EXPECT_EQ(text(240 * 3661 + 120), "11:01:01.500");
}

TEST(Performer, RepeatsCharacterInformation) {
    Performer performer(settingsOf(Revision::N, {2, 12, 13}));
    std::vector<std::uint64_t> metaData;
    std::vector<std::uint64_t> nullPoses;
    for (std::uint64_t frame = 0; frame < 240 * 11; ++frame) {
        const auto types = typesIn(performer.frame(frame));
        if (types.count(12) > 0) {
            metaData.push_back(frame);
        }
        if (types.count(13) > 0) {
            nullPoses.push_back(frame);
        }
    }
    EXPECT_EQ(metaData,
              (std::vector<std::uint64_t>{0, 240, 480, 720, 960, 1200, 1440, 1680, 1920, 2160, 2400}));
    EXPECT_EQ(nullPoses, (std::vector<std::uint64_t>{0, 1200, 2400}));
}

TEST(Performer, SendsTheNullPoseInPartsLikeRealSenders) {
    PerformerSettings settings = settingsOf(Revision::N, {13});
    settings.characters = 1;
    const std::vector<wire::Datagram> parts = Performer(settings).frame(0);
    ASSERT_EQ(parts.size(), 6U);
    std::size_t points = 0;
    for (std::size_t part = 0; part < parts.size(); ++part) {
        const auto& body = std::get<wire::NullPose>(parts[part].body);
        EXPECT_EQ(parts[part].header.datagramIndex(), part);
        EXPECT_EQ(parts[part].header.isLast(), part + 1 == parts.size());
        EXPECT_EQ(parts[part].header.items, 0);
        EXPECT_EQ(body.segments.size(), part == 0 ? 23U : 0U);
        EXPECT_EQ(body.points.empty(), part == 0);
        EXPECT_LE(wire::payloadSize(parts[part].body) + wire::kHeaderSize, 1472U) << "fits an Ethernet frame";
        points += body.points.size();
    }
    EXPECT_EQ(points, 127U);
    const auto& first = std::get<wire::NullPose>(parts.front().body);
    EXPECT_EQ(first.segments.front().name, "Pelvis");
    EXPECT_NEAR(first.segments[18].position[2], 0.0F, 1e-9F) << "ball of the foot";
}

TEST(Performer, NamesAndColoursCharactersApart) {
    std::set<std::string> names;
    std::set<std::string> colours;
    for (int character = 0; character < kMaxCharacters; ++character) {
        const Identity identity = identityOf(character);
        names.insert(identity.name);
        if (character < 8) {
            colours.insert(identity.colour);
        }
    }
    EXPECT_EQ(names.size(), static_cast<std::size_t>(kMaxCharacters));
    EXPECT_EQ(colours.size(), 8U);
    EXPECT_EQ(identityOf(0).colour, "2f72c4");

    Performer performer(settingsOf(Revision::N, {12}));
    const auto datagrams = performer.frame(0);
    const auto& text = std::get<wire::MetaData>(datagrams[1].body).text;
    EXPECT_NE(text.find("name:" + identityOf(1).name + "\n"), std::string::npos);
    EXPECT_NE(text.find("color:" + identityOf(1).colour + "\n"), std::string::npos);
    EXPECT_EQ(text.back(), '\n');
}

TEST(Performer, FillsTheHeaderAsSendersSince2019) {
    PerformerSettings settings = settingsOf(Revision::N);
    settings.props = 1;
    settings.fingers = true;
    for (const wire::Datagram& datagram : Performer(settings).frame(0)) {
        const bool isBodyAlone = datagram.header.type() == 5;
        EXPECT_EQ(datagram.header.bodySegments, 23);
        EXPECT_EQ(datagram.header.props, isBodyAlone ? 0 : 1);
        EXPECT_EQ(datagram.header.fingerSegments, isBodyAlone ? 0 : 40);
        EXPECT_EQ(datagram.header.payloadSize, wire::payloadSize(datagram.body));
    }
}

TEST(Performer, ProducesTheLargestPose) {
    PerformerSettings settings = settingsOf(Revision::N, {1, 2, 13, 21, 22});
    settings.props = 4;
    settings.fingers = true;
    const auto datagrams = Performer(settings).frame(0);
    const auto& pose = std::get<wire::PoseQuaternion>(firstOf(datagrams, 2)->body);
    ASSERT_EQ(pose.segments.size(), 67U);
    for (std::size_t place = 0; place < pose.segments.size(); ++place) {
        EXPECT_EQ(pose.segments[place].id, place + 1);
    }
    EXPECT_EQ(wire::encode(*firstOf(datagrams, 2))->size(), 2168U);
    EXPECT_EQ(std::get<wire::LinearKinematics>(firstOf(datagrams, 21)->body).segments.size(), 67U);
    const auto& nullPose = std::get<wire::NullPose>(firstOf(datagrams, 13)->body);
    ASSERT_EQ(nullPose.segments.size(), 67U);
    EXPECT_EQ(nullPose.segments[23].name, "Sword");
    EXPECT_EQ(nullPose.segments[27].name, "LeftCarpus");
    EXPECT_EQ(nullPose.segments[66].name, "RightFifthDP");
}

TEST(Performer, PlaysRevisionE) {
    PerformerSettings settings = settingsOf(Revision::E);
    settings.props = 1;
    settings.fingers = true;
    Performer performer(settings);
    const auto datagrams = performer.frame(0);
    const auto types = typesIn(datagrams);
    EXPECT_EQ(std::set<int>(types.begin(), types.end()), (std::set<int>{1, 2, 3, 4, 10, 11, 12}));
    for (const wire::Datagram& datagram : datagrams) {
        EXPECT_EQ(datagram.header.countedSegments(), 0U);
        EXPECT_EQ(datagram.header.payloadSize, 0);
    }
    EXPECT_FALSE(std::get<wire::MetaData>(firstOf(datagrams, 12)->body).hasLengthPrefix);
    EXPECT_EQ(std::get<wire::PropInformation>(firstOf(datagrams, 11)->body).props.front().id, 25U);
    EXPECT_EQ(std::get<wire::PoseQuaternion>(firstOf(datagrams, 2)->body).segments.size(), 24U)
        << "no fingers then";
    const auto& markers = std::get<wire::PointPositions>(firstOf(datagrams, 3)->body).points;
    EXPECT_EQ(markers.front().id, 101U);
    const auto sacrum = std::ranges::find_if(markers, [](const auto& point) { return point.id == 113U; });
    EXPECT_NE(sacrum, markers.end());
}

TEST(Performer, PlaysRevisionsJAndK) {
    for (const Revision revision : {Revision::J, Revision::K}) {
        Performer performer(settingsOf(revision));
        const auto datagrams = performer.frame(0);
        const auto types = typesIn(datagrams);
        EXPECT_EQ(std::set<int>(types.begin(), types.end()),
                  (std::set<int>{1, 2, 3, 5, 12, 13, 20, 21, 22, 23, 24, 25}));
        EXPECT_EQ(wire::payloadSize(firstOf(datagrams, 24)->body), 12U);
        EXPECT_EQ(wire::payloadSize(firstOf(datagrams, 25)->body), 16U);
        EXPECT_NE(std::get<wire::MetaData>(firstOf(datagrams, 12)->body).text.find("timeOffset:"),
                  std::string::npos);
        EXPECT_TRUE(std::get<wire::MetaData>(firstOf(datagrams, 12)->body).hasLengthPrefix);
        EXPECT_EQ(firstOf(datagrams, 2)->header.payloadSize, 0);
        EXPECT_EQ(std::get<wire::PointPositions>(firstOf(datagrams, 3)->body).points.front().id, 257U);
    }
    const auto modern = Performer(settingsOf(Revision::N)).frame(0);
    EXPECT_EQ(wire::payloadSize(firstOf(modern, 24)->body), 36U);
    EXPECT_EQ(wire::payloadSize(firstOf(modern, 25)->body), 16U);
}

TEST(Performer, WritesTheFormsOfThePaperIfAsked) {
    PerformerSettings settings = settingsOf(Revision::K);
    settings.asOnPaper = true;
    const auto datagrams = Performer(settings).frame(0);
    EXPECT_EQ(wire::payloadSize(firstOf(datagrams, 25)->body), 12U);
    EXPECT_EQ(std::get<wire::MetaData>(firstOf(datagrams, 12)->body).text.find("timeOffset:"),
              std::string::npos);
}

TEST(Performer, CountsInTheHeaderOfType05WhatItHolds) {
    PerformerSettings settings;
    settings.props = 2;
    settings.fingers = true;
    const auto datagrams = Performer(settings).frame(0);
    EXPECT_EQ(firstOf(datagrams, 5)->header.countedSegments(), firstOf(datagrams, 5)->header.items);
    EXPECT_EQ(firstOf(datagrams, 2)->header.countedSegments(), firstOf(datagrams, 2)->header.items);
}

TEST(Performer, SaysWhatIsWrongWithSettings) {
    EXPECT_EQ(findProblem(PerformerSettings{}), std::nullopt);
    PerformerSettings settings;
    settings.characters = 0;
    EXPECT_TRUE(findProblem(settings).has_value());
    settings = {};
    settings.rateHz = 0.0;
    EXPECT_TRUE(findProblem(settings).has_value());
    settings = {};
    settings.motion = "moonwalk";
    EXPECT_NE(findProblem(settings)->find("moonwalk"), std::string::npos);
    settings = settingsOf(Revision::E, {2, 20});
    EXPECT_NE(findProblem(settings)->find("20"), std::string::npos);
    settings = {};
    settings.props = 5;
    EXPECT_TRUE(findProblem(settings).has_value());
    for (const std::string_view motion : motionNames()) {
        settings = {};
        settings.motion = std::string(motion);
        EXPECT_EQ(findProblem(settings), std::nullopt);
    }
}

TEST(Performer, ShowsTheSameMotionAtEveryRate) {
    PerformerSettings settings = settingsOf(Revision::N, {2});
    settings.rateHz = 60.0;
    Performer slow(settings);
    settings.rateHz = 240.0;
    Performer fast(settings);
    for (std::uint64_t frame = 0; frame < 60; frame += 7) {
        const auto a = std::get<wire::PoseQuaternion>(firstOf(slow.frame(frame), 2)->body);
        const auto b = std::get<wire::PoseQuaternion>(firstOf(fast.frame(4 * frame), 2)->body);
        EXPECT_EQ(a, b);
    }
}

} // namespace
} // namespace posewire::performer
