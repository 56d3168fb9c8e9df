// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/codec.h"
#include "core/wire/form.h"

#include <bit>
#include <optional>
#include <random>

/// Messages of any type with made-up values, so that tests need not name every field.
namespace posewire::wire::test {

inline constexpr std::array<std::uint8_t, 15> kAllTypes{1,  2,  3,  4,  5,  10, 11, 12,
                                                        13, 20, 21, 22, 23, 24, 25};

/// How much of a generated message is left to chance.
struct Generated {
    std::mt19937& random;
    bool onlyFinite = true;
    std::optional<std::size_t> items{}; ///< in each list; else 1 to 67, or 0 to 29 in lists with a count
};

/// Fills any message with random values by walking its layout.
struct Filler {
    Generated how;

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
        for (std::size_t n = how.random() % 40; n > 0; --n) {
            text += pieces[how.random() % pieces.size()];
        }
    }
    template <class T, auto Member, Form ItemForm, std::size_t Max>
    void fillField(T& value, const Items<Member, ItemForm, Max>&) {
        const std::size_t chosen = Max != 0 ? how.random() % 30 : 1 + how.random() % 67;
        fillList<ItemForm>(value.*Member, how.items.value_or(chosen));
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
        value = static_cast<Value>(how.random());
    }
    template <std::size_t N>
    void fillValue(std::array<char, N>& characters) {
        for (char& character : characters) {
            character = static_cast<char>('0' + how.random() % 10);
        }
    }
    template <std::size_t N>
    void fillValue(std::array<float, N>& values) {
        for (float& value : values) {
            const std::uint32_t bits = static_cast<std::uint32_t>(how.random());
            value = std::bit_cast<float>(how.onlyFinite ? bits & 0xbfffffffU : bits);
        }
    }
};

/// The form that types come in besides the standard one, for those that have another.
[[nodiscard]] inline Form otherForm(std::uint8_t type) {
    const bool hasShort = type == TrackerKinematics::kType || type == CentreOfMass::kType;
    const bool hasBare = type == MetaData::kType || type == TimeCode::kType;
    return hasShort ? Form::Short : hasBare ? Form::Bare : Form::Standard;
}

/// A message of that type and form; random header fields, but those that completeHeader sets.
[[nodiscard]] inline Datagram generatedDatagram(const Generated& how, std::uint8_t type, Form form,
                                                HeaderEra era) {
    Datagram datagram;
    Filler{how}.fill<Header, Form::Standard>(datagram.header);
    datagram.header.id = Header{}.id;
    withMessage(datagram.body, type, [&]<class T>(T& value) {
        setForm(value, form);
        withForm<T>(form, [&]<Form F>() { Filler{how}.fill<T, F>(value); });
    });
    completeHeader(datagram, era);
    return datagram;
}

} // namespace posewire::wire::test
