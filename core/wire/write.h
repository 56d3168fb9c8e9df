// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/byte_order.h"
#include "core/wire/field.h"

/// Writes values by walking their layouts, the mirror image of walk.h.
namespace posewire::wire {

template <class T, Form F>
[[nodiscard]] std::size_t writtenSize(const T& value);
template <class T, Form F>
std::byte* writeLayout(std::byte* to, const T& value);

namespace detail {

template <auto Member, class T>
std::size_t sizeOfField(const Field<Member>&, const T&) {
    return sizeof(MemberValue<Member>);
}

template <auto Member, TextKind Kind, class T>
std::size_t sizeOfField(const Text<Member, Kind>&, const T& value) {
    const std::size_t frame = Kind == TextKind::Prefixed ? 4 : Kind == TextKind::ZeroTerminated ? 1 : 0;
    return frame + (value.*Member).size();
}

template <Form F, class Item>
std::size_t sizeOfItems(const std::vector<Item>& list) {
    if constexpr (kIsFixed<Item, F>) {
        return list.size() * kWireSize<Item, F>;
    } else {
        std::size_t sum = 0;
        for (const Item& item : list) {
            sum += writtenSize<Item, F>(item);
        }
        return sum;
    }
}

template <auto Member, Form ItemForm, class T>
std::size_t sizeOfField(const Items<Member, ItemForm>&, const T& value) {
    return sizeOfItems<ItemForm>(value.*Member);
}

template <auto Member, std::size_t Max, class T>
std::size_t sizeOfField(const CountedList<Member, Max>&, const T& value) {
    return 4 + sizeOfItems<Form::Standard>(value.*Member);
}

template <auto Member, class T>
std::byte* writeField(std::byte* to, const Field<Member>&, const T& value) {
    storeValue(to, value.*Member);
    return to + sizeof(MemberValue<Member>);
}

template <auto Member, TextKind Kind, class T>
std::byte* writeField(std::byte* to, const Text<Member, Kind>&, const T& value) {
    const std::string& text = value.*Member;
    if constexpr (Kind == TextKind::Prefixed) {
        store32(to, static_cast<std::uint32_t>(text.size()));
        to += 4;
    }
    to = std::copy_n(reinterpret_cast<const std::byte*>(text.data()), text.size(), to);
    if constexpr (Kind == TextKind::ZeroTerminated) {
        *to++ = std::byte{0};
    }
    return to;
}

template <Form F, class Item>
std::byte* writeItems(std::byte* to, const std::vector<Item>& list) {
    for (const Item& item : list) {
        to = writeLayout<Item, F>(to, item);
    }
    return to;
}

template <auto Member, Form ItemForm, class T>
std::byte* writeField(std::byte* to, const Items<Member, ItemForm>&, const T& value) {
    return writeItems<ItemForm>(to, value.*Member);
}

template <auto Member, std::size_t Max, class T>
std::byte* writeField(std::byte* to, const CountedList<Member, Max>&, const T& value) {
    store32(to, static_cast<std::uint32_t>((value.*Member).size()));
    return writeItems<Form::Standard>(to + 4, value.*Member);
}

} // namespace detail

/// Bytes that writeLayout will write.
template <class T, Form F>
std::size_t writtenSize(const T& value) {
    std::size_t sum = 0;
    forEachField<T, F>([&](const auto& field) { sum += detail::sizeOfField(field, value); });
    return sum;
}

/// Writes one value and returns the end; the caller has made writtenSize bytes of room.
template <class T, Form F>
std::byte* writeLayout(std::byte* to, const T& value) {
    forEachField<T, F>([&](const auto& field) { to = detail::writeField(to, field, value); });
    return to;
}

} // namespace posewire::wire
