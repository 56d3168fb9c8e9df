// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/byte_order.h"
#include "core/wire/field.h"

#include <algorithm>

/// Writes values by walking their layouts, the mirror image of walk.h. A sink takes the values: one counts
/// their bytes, one writes them, so that both always agree.
namespace posewire::wire {

/// Counts bytes.
struct ByteCounter {
    std::size_t size = 0;

    void put(const auto& value) { size += sizeof value; }
    void put(std::string_view text) { size += text.size(); }
};

/// Writes bytes; the caller has made the room.
struct ByteWriter {
    std::byte* to;

    void put(const auto& value) {
        storeValue(to, value);
        to += sizeof value;
    }
    void put(std::string_view text) {
        to = std::copy_n(reinterpret_cast<const std::byte*>(text.data()), text.size(), to);
    }
};

template <class T, Form F, class Sink>
Sink putLayout(Sink sink, const T& value);

namespace detail {

template <auto Member, class T, class Sink>
Sink putField(Sink sink, const Field<Member>&, const T& value) {
    sink.put(value.*Member);
    return sink;
}

template <auto Member, TextKind Kind, class T, class Sink>
Sink putField(Sink sink, const Text<Member, Kind>&, const T& value) {
    const std::string& text = value.*Member;
    if constexpr (Kind == TextKind::Prefixed) {
        sink.put(static_cast<std::uint32_t>(text.size()));
    }
    sink.put(std::string_view(text));
    if constexpr (Kind == TextKind::ZeroTerminated) {
        sink.put(std::uint8_t{0});
    }
    return sink;
}

template <auto Member, Form ItemForm, std::size_t Max, class T, class Sink>
Sink putField(Sink sink, const Items<Member, ItemForm, Max>&, const T& value) {
    const auto& list = value.*Member;
    if constexpr (Max != 0) {
        sink.put(static_cast<std::uint32_t>(list.size()));
    }
    for (const auto& item : list) {
        sink = putLayout<typename MemberValue<Member>::value_type, ItemForm>(sink, item);
    }
    return sink;
}

} // namespace detail

/// Puts one value into a sink, field by field. Sinks go by value, so that what is written cannot alias them.
template <class T, Form F, class Sink>
Sink putLayout(Sink sink, const T& value) {
    forEachField<T, F>([&](const auto& field) { sink = detail::putField(sink, field, value); });
    return sink;
}

/// Bytes that a value is written to.
template <class T, Form F>
[[nodiscard]] std::size_t writtenSize(const T& value) {
    return putLayout<T, F>(ByteCounter{}, value).size;
}

} // namespace posewire::wire
