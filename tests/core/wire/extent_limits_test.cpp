// SPDX-License-Identifier: MIT
#include "core/wire/byte_order.h"
#include "core/wire/header.h"
#include "tests/core/wire/generated_datagrams.h"

#include <gtest/gtest.h>

namespace posewire::wire {
namespace {

using State = Extent::State;

std::vector<std::byte> sent(const Body& body, HeaderEra era = HeaderEra::Reserved) {
    Datagram datagram;
    datagram.body = body;
    completeHeader(datagram, era);
    return encode(datagram).value();
}

std::vector<std::byte> followed(std::vector<std::byte> bytes, std::string_view by) {
    for (const char character : by) {
        bytes.push_back(static_cast<std::byte>(character));
    }
    return bytes;
}

class GeneratedExtent : public testing::TestWithParam<std::uint8_t> {};
INSTANTIATE_TEST_SUITE_P(AllTypes, GeneratedExtent, testing::ValuesIn(test::kAllTypes));

/// Older senders leave the payload size out; then the type and the number of items give it.
TEST_P(GeneratedExtent, IsComputedWithoutAPayloadSize) {
    std::mt19937 random(GetParam());
    for (const std::size_t items : {1U, 2U, 23U, 67U, 255U}) {
        for (const Form form : {Form::Standard, test::otherForm(GetParam())}) {
            if (GetParam() == MetaData::kType && form == Form::Bare) {
                continue; // nothing says where a bare text ends
            }
            const auto datagram =
                test::generatedDatagram({random, true, items}, GetParam(), form, HeaderEra::Reserved);
            const auto bytes = encode(datagram).value();
            EXPECT_EQ(datagramExtent(followed(bytes, "MXTP02"), false), (Extent{State::Known, bytes.size()}));
            EXPECT_EQ(datagramExtent(bytes, true), (Extent{State::Known, bytes.size()}));
            const Bytes cut = Bytes(bytes).first(bytes.size() - 1);
            EXPECT_NE(datagramExtent(cut, false), (Extent{State::Known, cut.size()}));
        }
    }
}

TEST_P(GeneratedExtent, IsThatOfTheHeaderWhateverThePayload) {
    std::mt19937 random(GetParam());
    for (const std::uint16_t size : std::initializer_list<std::uint16_t>{1, 17, 255, 256, 4096, 65'483}) {
        auto bytes =
            encode(test::generatedDatagram({random}, GetParam(), Form::Standard, HeaderEra::Counted)).value();
        store16(bytes.data() + 22, size);
        EXPECT_EQ(datagramExtent(Bytes(bytes).first(kHeaderSize), false),
                  (Extent{State::Known, kHeaderSize + size}));
    }
}

TEST_P(GeneratedExtent, IsUnknownWhereTheHeaderAnnouncesTooMuch) {
    std::mt19937 random(GetParam());
    for (const std::uint16_t size : std::initializer_list<std::uint16_t>{65'484, 65'535}) {
        auto bytes =
            encode(test::generatedDatagram({random}, GetParam(), Form::Standard, HeaderEra::Counted)).value();
        store16(bytes.data() + 22, size);
        EXPECT_EQ(datagramExtent(bytes, false).state, State::Unknown);
        EXPECT_EQ(datagramExtent(bytes, true).state, State::Unknown);
    }
}

TEST(ExtentOfANullPose, WaitsAsLongAsTheCountsCanBeMeant) {
    const auto bytes = sent(NullPose{{{"Pelvis", {}}, {"L5", {}}}, {{1, 13, "pSacrum", 0, {}}}});
    for (std::size_t length = kHeaderSize; length < bytes.size(); ++length) {
        EXPECT_EQ(datagramExtent(Bytes(bytes).first(length), false).state, State::NeedMore) << length;
        EXPECT_EQ(datagramExtent(Bytes(bytes).first(length), true).state, State::Unknown) << length;
    }
}

TEST(ExtentOfANullPose, IsUnknownForACountBeyondTheMost) {
    auto bytes = sent(NullPose{});
    const auto stateWith = [&](std::uint32_t segments, std::uint32_t points) {
        store32(bytes.data() + 24, segments);
        store32(bytes.data() + 28, points);
        return datagramExtent(bytes, false).state;
    };
    EXPECT_EQ(stateWith(0, 0), State::Known);
    EXPECT_EQ(stateWith(0, kMaxNullPosePoints), State::NeedMore);
    EXPECT_EQ(stateWith(0, kMaxNullPosePoints + 1), State::Unknown);
    EXPECT_EQ(stateWith(kMaxNullPoseSegments, 0), State::NeedMore);
    EXPECT_EQ(stateWith(0xffffffff, 0), State::Unknown);
}

TEST(ExtentOfANullPose, IsUnknownForANameThatIsNoText) {
    auto bytes = sent(NullPose{{{"Pelvis", {}}}, {}});
    bytes[kHeaderSize + 8] = std::byte{0xff};
    EXPECT_EQ(datagramExtent(bytes, false).state, State::Unknown);
}

TEST(ExtentOfANullPose, IsUnknownWhereTheLongestDatagramDoesNotHoldIt) {
    auto bytes = sent(NullPose{});
    store32(bytes.data() + 28, kMaxNullPosePoints);
    bytes.resize(kMaxDatagramSize - 1);
    EXPECT_EQ(datagramExtent(bytes, false).state, State::NeedMore);
    bytes.resize(kMaxDatagramSize);
    EXPECT_EQ(datagramExtent(bytes, false).state, State::Unknown);
}

TEST(ExtentOfProps, EndsWithTheZeroOfTheLastName) {
    const auto bytes = sent(PropInformation{{{24, "Sword"}, {25, ""}, {26, "Gun"}}});
    const auto stream = followed(bytes, "anything");
    for (std::size_t length = kHeaderSize; length <= stream.size(); ++length) {
        const Extent extent = datagramExtent(Bytes(stream).first(length), false);
        EXPECT_EQ(extent, length < bytes.size() ? (Extent{State::NeedMore, 0})
                                                : (Extent{State::Known, bytes.size()}));
    }
    auto damaged = bytes;
    damaged[kHeaderSize + 4] = std::byte{0xc0};
    EXPECT_EQ(datagramExtent(damaged, false).state, State::Unknown);
}

TEST(ExtentOfMetadata, IsUnknownForALengthThatCannotBe) {
    auto bytes = sent(MetaData{true, "name:A\n"});
    for (const std::uint32_t length : {0xffffffffU, 0x80000000U, 65'508U, 0x6e616d65U}) {
        store32(bytes.data() + 24, length);
        EXPECT_EQ(datagramExtent(bytes, false).state, State::Unknown) << length;
    }
    store32(bytes.data() + 24, kMaxDatagramSize - kHeaderSize - 4);
    EXPECT_EQ(datagramExtent(bytes, false), (Extent{State::Known, kMaxDatagramSize}));
    EXPECT_EQ(datagramExtent(Bytes(bytes).first(27), false).state, State::NeedMore);
    EXPECT_EQ(datagramExtent(Bytes(bytes).first(27), true).state, State::Unknown);
}

/// The two sizes of a tracker, of a centre of mass: the one that another datagram follows is right.
TEST(ExtentOfTwoForms, IsTheOneThatAnotherDatagramFollows) {
    TrackerKinematics trackers{true, std::vector<Tracker>(3, {1, {1, 0, 0, 0}, {}, {}, {}, {}})};
    CentreOfMass centre;
    for (const bool isLong : {true, false}) {
        trackers.hasInertialData = isLong;
        centre.hasDerivatives = isLong;
        for (const auto& bytes : {sent(trackers), sent(centre)}) {
            const auto stream = followed(bytes, "MXTP20");
            const auto other = followed(bytes, std::string(100, 'x'));
            EXPECT_EQ(datagramExtent(stream, false), (Extent{State::Known, bytes.size()}));
            EXPECT_EQ(datagramExtent(other, true).state, State::Unknown);
            EXPECT_EQ(datagramExtent(followed(bytes, "MXT"), false).state, State::NeedMore);
        }
    }
}

TEST(ExtentOfATimeCode, WaitsToSeeWhetherTheLengthWasCounted) {
    const std::string text = "12:34:56.789";
    TimeCode message;
    std::copy(text.begin(), text.end(), message.text.begin());
    message.length = 0;
    auto bytes = sent(message, HeaderEra::Counted);
    store16(bytes.data() + 22, 12); // one sender leaves the length out of its count
    for (std::size_t length = kHeaderSize; length < kHeaderSize + 12; ++length) {
        EXPECT_EQ(datagramExtent(Bytes(bytes).first(length), false).state, State::NeedMore);
    }
    EXPECT_EQ(datagramExtent(Bytes(bytes).first(kHeaderSize + 12), false),
              (Extent{State::Known, kHeaderSize + 16}));
    message.hasLengthPrefix = false;
    EXPECT_EQ(datagramExtent(sent(message, HeaderEra::Counted), false),
              (Extent{State::Known, kHeaderSize + 12}));
}

TEST(ExtentOfAnUnknownType, IsUnknownWithoutAPayloadSize) {
    for (const std::uint8_t type : std::initializer_list<std::uint8_t>{0, 6, 14, 26, 99}) {
        Datagram datagram;
        datagram.header.setType(type);
        datagram.body = RawBody{std::vector<std::byte>(10)};
        const auto bytes = encode(datagram).value();
        EXPECT_EQ(datagramExtent(bytes, false).state, State::Unknown) << int{type};
        EXPECT_EQ(datagramExtent(bytes, true).state, State::Unknown) << int{type};
    }
}

} // namespace
} // namespace posewire::wire
