// SPDX-License-Identifier: MIT
#include "tests/core/wire/generated_datagrams.h"

#include <gtest/gtest.h>

namespace posewire::wire {
namespace {

Datagram randomDatagram(std::mt19937& random, std::uint8_t type, bool onlyFinite) {
    const Form form = random() % 2 == 0 ? Form::Standard : test::otherForm(type);
    const HeaderEra era = random() % 2 == 0 ? HeaderEra::Counted : HeaderEra::Reserved;
    return test::generatedDatagram({random, onlyFinite}, type, form, era);
}

class RandomRoundTrip : public testing::TestWithParam<std::uint8_t> {};
INSTANTIATE_TEST_SUITE_P(AllTypes, RandomRoundTrip, testing::ValuesIn(test::kAllTypes));

TEST_P(RandomRoundTrip, GivesBackTheSameValues) {
    std::mt19937 random(1000U + GetParam());
    for (int round = 0; round < 1000; ++round) {
        const Datagram datagram = randomDatagram(random, GetParam(), true);
        const auto bytes = encode(datagram);
        ASSERT_TRUE(bytes) << errorText(bytes.error());
        EXPECT_EQ(bytes->size(), kHeaderSize + payloadSize(datagram.body));
        const auto decoded = decode(*bytes);
        ASSERT_TRUE(decoded) << errorText(decoded.error());
        EXPECT_EQ(decoded->header, datagram.header);
        EXPECT_TRUE(decoded->body == datagram.body);
    }
}

TEST_P(RandomRoundTrip, GivesBackTheSameBitsWhateverTheFloats) {
    std::mt19937 random(2000U + GetParam());
    for (int round = 0; round < 1000; ++round) {
        const auto bytes = encode(randomDatagram(random, GetParam(), false));
        ASSERT_TRUE(bytes);
        const auto decoded = decode(*bytes);
        ASSERT_TRUE(decoded) << errorText(decoded.error());
        EXPECT_EQ(*encode(*decoded), *bytes);
    }
}

} // namespace
} // namespace posewire::wire
