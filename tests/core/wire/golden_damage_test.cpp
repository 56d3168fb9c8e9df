// SPDX-License-Identifier: MIT
#include "tests/core/wire/expected_datagrams.h"
#include "tests/core/wire/golden_fixture.h"

namespace posewire::wire::test {
namespace {

class GoldenDamage : public GoldenTest {
protected:
    /// The only cuts that give another datagram in good order: where older headers do not say the size, and
    /// the rest is a whole message of its own.
    [[nodiscard]] bool readsAsAnotherMessage(std::size_t length) const {
        if (isNamed({"12_metadata_bare"})) {
            return length == kHeaderSize || bytes()[length - 1] == std::byte{'\n'}; // fewer lines of text
        }
        if (isNamed({"12_metadata_reserved"})) {
            return length == kHeaderSize; // no text at all
        }
        return isNamed({"24_centre_36_reserved"}) && length == kHeaderSize + 12; // the short form
    }
};
INSTANTIATE_TEST_SUITE_P(All, GoldenDamage, testing::ValuesIn(goldenNames()), goldenTestName);

TEST_P(GoldenDamage, IsNeverReadFromLessThanAllOfItsBytes) {
    const Datagram whole = expectedDatagram(name());
    for (std::size_t length = 0; length < bytes().size(); ++length) {
        const auto cut = decode(first(length));
        if (!cut) {
            EXPECT_LE(cut.error().offset, length) << "cut at " << length;
            EXPECT_NE(cut.error().code, ErrorCode::TooLong) << "cut at " << length;
            continue;
        }
        EXPECT_TRUE(whole.header.payloadSize == 0 || isNamed({"25_time_code_miscounted"}))
            << "cut at " << length;
        EXPECT_FALSE(cut->body == whole.body) << "cut at " << length;
        EXPECT_EQ(cut->notices.empty(), readsAsAnotherMessage(length)) << "cut at " << length;
    }
}

TEST_P(GoldenDamage, IsAnErrorWhereTheHeaderIsCut) {
    for (std::size_t length = 0; length < kHeaderSize; ++length) {
        const auto cut = decode(first(length));
        ASSERT_FALSE(cut);
        EXPECT_EQ(cut.error(), (WireError{ErrorCode::HeaderTruncated, 0, static_cast<std::uint32_t>(length),
                                          kHeaderSize, static_cast<std::uint32_t>(length)}));
    }
}

TEST_P(GoldenDamage, IsAnErrorWhereTheAnnouncedPayloadIsCut) {
    const std::size_t announced = kHeaderSize + expectedDatagram(name()).header.payloadSize;
    for (std::size_t length = kHeaderSize; length < announced; ++length) {
        const auto cut = decode(first(length));
        ASSERT_FALSE(cut) << "cut at " << length;
        EXPECT_EQ(cut.error().code, ErrorCode::PayloadTruncated);
        EXPECT_EQ(cut.error().need, announced);
        EXPECT_EQ(cut.error().have, length);
        EXPECT_EQ(cut.error().type, expectedDatagram(name()).header.type());
    }
}

TEST_P(GoldenDamage, GivesANoticeForOneByteMore) {
    const Datagram whole = expectedDatagram(name());
    for (const char extra : {'\0', 'x', '\n'}) {
        std::vector<std::byte> longer = bytes();
        longer.push_back(static_cast<std::byte>(extra));
        const auto datagram = decode(longer);
        ASSERT_TRUE(datagram) << errorText(datagram.error());
        if (isNamed({"12_metadata_bare"})) {
            EXPECT_EQ(std::get<MetaData>(datagram->body).text.size(), longer.size() - kHeaderSize);
        } else if (isNamed({"77_unknown_reserved", "04_tags_reserved"})) {
            EXPECT_EQ(std::get<RawBody>(datagram->body).bytes.size(), longer.size() - kHeaderSize);
        } else {
            EXPECT_TRUE(datagram->body == whole.body);
        }
        EXPECT_FALSE(datagram->notices.empty());
        EXPECT_TRUE(datagram->notices != whole.notices || isNamed({"77_unknown_reserved"}));
        for (const Notice& notice : datagram->notices) {
            EXPECT_LT(notice.offset, longer.size());
        }
    }
}

/// What an error or a notice names lies inside the datagram, whatever the bytes.
TEST_P(GoldenDamage, SurvivesEveryChangedByte) {
    for (std::size_t place = 0; place < bytes().size(); ++place) {
        for (const unsigned value : {0x00U, 0x7fU, 0x80U, 0xffU}) {
            std::vector<std::byte> changed = bytes();
            changed[place] = static_cast<std::byte>(value);
            const auto datagram = decode(changed);
            if (!datagram) {
                EXPECT_LE(datagram.error().offset, changed.size());
                continue;
            }
            for (const Notice& notice : datagram->notices) {
                EXPECT_LT(notice.offset, changed.size());
            }
        }
    }
}

} // namespace
} // namespace posewire::wire::test
