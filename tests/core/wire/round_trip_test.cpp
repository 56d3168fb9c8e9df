// SPDX-License-Identifier: MIT
#include "core/wire/codec.h"
#include "core/wire/form.h"

#include <gtest/gtest.h>

#include <bit>
#include <concepts>
#include <limits>
#include <random>

namespace posewire::wire {
namespace {

/// Fills any message with random values by walking its layout.
struct Filler {
    std::mt19937& random;
    bool onlyFinite;

    template <class T, Form F>
    void fill(T& value) {
        forEachField<T, F>([&](const auto& field) { fillField(value, field); });
    }

private:
    template <class T, auto Member>
    void fillField(T& value, const Field<Member>&) {
        fillValue(value.*Member);
    }
    template <class T, auto Member, TextKind Kind>
    void fillField(T& value, const Text<Member, Kind>&) {
        constexpr std::array<const char*, 6> pieces{"a", ":", "\n", "\u00e9", "\u20ac", "\U0001f600"};
        std::string& text = value.*Member;
        text = Kind == TextKind::ToEnd ? "name:" : "";
        for (std::size_t n = random() % 40; n > 0; --n) {
            text += pieces[random() % pieces.size()];
        }
    }
    template <class T, auto Member, Form ItemForm, std::size_t Max>
    void fillField(T& value, const Items<Member, ItemForm, Max>&) {
        fillList<ItemForm>(value.*Member, Max != 0 ? random() % 30 : 1 + random() % 67);
    }
    template <Form F, class Item>
    void fillList(std::vector<Item>& list, std::size_t count) {
        list.resize(count);
        for (Item& item : list) {
            fill<Item, F>(item);
        }
    }
    template <std::integral Value>
    void fillValue(Value& value) {
        value = static_cast<Value>(random());
    }
    template <std::size_t N>
    void fillValue(std::array<char, N>& characters) {
        for (char& character : characters) {
            character = static_cast<char>('0' + random() % 10);
        }
    }
    template <std::size_t N>
    void fillValue(std::array<float, N>& values) {
        for (float& value : values) {
            const std::uint32_t bits = static_cast<std::uint32_t>(random());
            value = std::bit_cast<float>(onlyFinite ? bits & 0xbfffffffU : bits);
        }
    }
};

constexpr std::array<std::uint8_t, 15> kTypes{1, 2, 3, 4, 5, 10, 11, 12, 13, 20, 21, 22, 23, 24, 25};

Datagram randomDatagram(std::mt19937& random, std::uint8_t type, bool onlyFinite) {
    Datagram datagram;
    Filler{random, onlyFinite}.fill<Header, Form::Standard>(datagram.header);
    datagram.header.id = Header{}.id;
    withMessage(datagram.body, type, [&]<class T>(T& value) {
        constexpr bool hasShort = std::is_same_v<T, TrackerKinematics> || std::is_same_v<T, CentreOfMass>;
        const Form other = hasShort ? Form::Short : Form::Bare;
        const Form form = random() % 2 == 0 ? Form::Standard : other;
        setForm(value, form);
        withForm<T>(form, [&]<Form F>() { Filler{random, onlyFinite}.fill<T, F>(value); });
    });
    completeHeader(datagram, random() % 2 == 0 ? HeaderEra::Counted : HeaderEra::Reserved);
    return datagram;
}

class RandomRoundTrip : public testing::TestWithParam<std::uint8_t> {};
INSTANTIATE_TEST_SUITE_P(AllTypes, RandomRoundTrip, testing::ValuesIn(kTypes));

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
