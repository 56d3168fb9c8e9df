// SPDX-License-Identifier: MIT
#include "core/wire/header.h"
#include "tests/core/wire/expected_datagrams.h"
#include "tests/core/wire/golden_fixture.h"

namespace posewire::wire::test {
namespace {

using State = Extent::State;

class GoldenExtent : public GoldenTest {
protected:
    /// Neither the header nor the content says how long these are.
    [[nodiscard]] bool isUntold() const { return isNamed({"12_metadata_bare", "77_unknown_reserved"}); }

    static std::vector<std::byte> followedBy(std::vector<std::byte> bytes, const std::string& next) {
        const auto& more = posewire::test::golden(next).bytes;
        bytes.insert(bytes.end(), more.begin(), more.end());
        return bytes;
    }
};
INSTANTIATE_TEST_SUITE_P(All, GoldenExtent, testing::ValuesIn(goldenNames()), goldenTestName);

TEST_P(GoldenExtent, IsNeverToldWrongFromAnyPrefixOfAStream) {
    for (const char* next : {"02_quaternion_reserved", "25_time_code_bare", "77_unknown_counted"}) {
        const std::vector<std::byte> stream = followedBy(bytes(), next);
        bool isTold = false;
        for (std::size_t length = 0; length <= stream.size(); ++length) {
            const Extent extent = datagramExtent(Bytes(stream).first(length), false);
            if (isUntold()) {
                // The first four bytes behind the header might be a length.
                const bool isDecided = length >= kHeaderSize + sizeof(std::uint32_t);
                EXPECT_TRUE(extent.state == State::Unknown || (!isDecided && extent.state == State::NeedMore))
                    << length;
                EXPECT_TRUE(extent.state == State::NeedMore || length >= kHeaderSize) << length;
                continue;
            }
            ASSERT_TRUE(extent.state == State::NeedMore || extent.state == State::Known) << length;
            EXPECT_TRUE(!isTold || extent.state == State::Known) << "forgotten at " << length;
            isTold = extent.state == State::Known;
            EXPECT_TRUE(!isTold || extent.size == bytes().size()) << length << " before " << next;
        }
        EXPECT_NE(isTold, isUntold()) << "before " << next;
    }
}

TEST_P(GoldenExtent, IsToldByTheHeaderAloneWhereItHasThePayloadSize) {
    const Header header = expectedDatagram(name()).header;
    if (header.payloadSize != 0 && !isNamed({"25_time_code_miscounted", "25_time_code_bare_counted"})) {
        EXPECT_EQ(datagramExtent(first(kHeaderSize), false), (Extent{State::Known, bytes().size()}));
    }
}

TEST_P(GoldenExtent, IsToldAtTheEndOfTheStream) {
    const Extent expected = isUntold() ? Extent{State::Unknown, 0} : Extent{State::Known, bytes().size()};
    EXPECT_EQ(datagramExtent(bytes(), true), expected);
}

TEST_P(GoldenExtent, DoesNotWaitForMoreAtTheEndOfTheStream) {
    for (std::size_t length = 0; length <= bytes().size(); ++length) {
        EXPECT_NE(datagramExtent(first(length), true).state, State::NeedMore) << length;
    }
}

TEST(Extent, IsForeignForWhatDoesNotBeginADatagram) {
    for (const std::string_view text : {"X", "MXP", "MXTPx", "MXTP0x", "{\"type\":\"transport\"}"}) {
        EXPECT_EQ(datagramExtent(std::as_bytes(std::span(text)), false).state, State::Foreign) << text;
    }
}

TEST(Extent, WaitsForMoreOfWhatMayBeginADatagram) {
    for (const std::string_view text : {"", "M", "MXTP", "MXTP0", "MXTP02"}) {
        EXPECT_EQ(datagramExtent(std::as_bytes(std::span(text)), false).state, State::NeedMore) << text;
    }
}

TEST(Extent, IsUnknownForACountThatNoDatagramCanHold) {
    std::vector<std::byte> bytes = posewire::test::golden("13_null_pose_reserved").bytes;
    std::fill_n(bytes.begin() + kHeaderSize, 4, std::byte{0xff});
    EXPECT_EQ(datagramExtent(bytes, false).state, State::Unknown);
}

TEST(Extent, IsUnknownBeyondTheLongestDatagram) {
    Datagram datagram;
    datagram.header.setType(2);
    datagram.header.payloadSize = 65535;
    EXPECT_EQ(datagramExtent(*encode(datagram), false).state, State::Unknown);
}

} // namespace
} // namespace posewire::wire::test
