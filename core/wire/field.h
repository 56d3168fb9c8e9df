// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/types.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

/// The vocabulary in which layouts are declared. A layout is a tuple of fields; decoding, encoding, sizes,
/// the field tree, JSON and the protocol reference all walk that tuple, so that a field is written down once.
namespace posewire::wire {

enum class Unit : std::uint8_t {
    None,
    Identifier,
    Count,
    ByteCount,
    Flags,
    Milliseconds,
    Metres,
    Centimetres,
    Degrees,
    MetresPerSecond,
    MetresPerSecondSquared,
    RadiansPerSecond,
    RadiansPerSecondSquared,
    ArbitraryUnits,
};

/// Symbol as shown to people, such as "m/s²"; empty where there is nothing to say.
std::string_view unitSymbol(Unit unit);

/// What a field is for people: the JSON key, its unit, one line, and where the specification defines it.
struct About {
    std::string_view name;
    Unit unit = Unit::None;
    std::string_view text;
    std::string_view section;
};

/// Some messages come in more than one layout; the form names it. core/wire/form.h tells which one bytes are
/// in.
enum class Form : std::uint8_t {
    Standard, ///< as the specification's newest revision that has the type
    Short,    ///< type 23 with 44 bytes an item, type 24 with the position alone
    Bare,     ///< type 12 and 25 without length prefix
    Unity,    ///< type 05: the item of type 02 in another frame
    Raw,      ///< kept as bytes: unknown type, or a type 04 that is not the one of revision E
};

/// A value of fixed size: an integer, Vec3, Quat, Mat3 or an array of characters.
template <auto Member>
struct Field {
    About about;
};

enum class TextKind : std::uint8_t {
    Prefixed,       ///< signed 32-bit length, then UTF-8 (§2.5.12)
    ZeroTerminated, ///< revision E
    ToEnd,          ///< revision E: the rest of the datagram
};

/// A string.
template <auto Member, TextKind Kind>
struct Text {
    About about;
};

/// Items of one layout whose number the header gives ("number of items", §2.4.1.4).
template <auto Member, Form ItemForm = Form::Standard>
struct Items {
    About about;
};

/// Items of one layout after a 32-bit count of their own, at most Max.
template <auto Member, std::size_t Max>
struct CountedList {
    About about;
};

/// Specialised for each item and message: `static constexpr auto fields = std::tuple{…}`.
template <class T, Form F = Form::Standard>
struct Layout;

template <class M>
struct MemberOf;
template <class C, class M>
struct MemberOf<M C::*> {
    using Owner = C;
    using Value = M;
};
template <auto Member>
using MemberValue = typename MemberOf<decltype(Member)>::Value;

/// Calls f(field) for each field of a layout, in wire order.
template <class T, Form F, class Function>
constexpr void forEachField(Function&& f) {
    std::apply([&](const auto&... field) { (f(field), ...); }, Layout<T, F>::fields);
}

namespace detail {

template <class T>
inline constexpr std::size_t kValueSize = sizeof(T);

template <class FieldType>
struct FixedSize {
    static constexpr bool isFixed = false;
    static constexpr std::size_t minimum = 4;
};
template <auto Member>
struct FixedSize<Field<Member>> {
    static constexpr bool isFixed = true;
    static constexpr std::size_t minimum = kValueSize<MemberValue<Member>>;
};
template <auto Member>
struct FixedSize<Text<Member, TextKind::ZeroTerminated>> {
    static constexpr bool isFixed = false;
    static constexpr std::size_t minimum = 1;
};
template <auto Member>
struct FixedSize<Text<Member, TextKind::ToEnd>> {
    static constexpr bool isFixed = false;
    static constexpr std::size_t minimum = 0;
};
template <auto Member, Form ItemForm>
struct FixedSize<Items<Member, ItemForm>> {
    static constexpr bool isFixed = false;
    static constexpr std::size_t minimum = 0;
};

template <class T, Form F>
constexpr std::size_t minimumSize() {
    std::size_t sum = 0;
    forEachField<T, F>(
        [&](const auto& field) { sum += FixedSize<std::remove_cvref_t<decltype(field)>>::minimum; });
    return sum;
}

template <class T, Form F>
constexpr bool hasFixedSize() {
    bool fixed = true;
    forEachField<T, F>([&](const auto& field) {
        fixed = fixed && FixedSize<std::remove_cvref_t<decltype(field)>>::isFixed;
    });
    return fixed;
}

} // namespace detail

/// True where every field has a fixed size.
template <class T, Form F = Form::Standard>
inline constexpr bool kIsFixed = detail::hasFixedSize<T, F>();

/// Bytes on the wire of a layout of fixed size; the least number of bytes for others.
template <class T, Form F = Form::Standard>
inline constexpr std::size_t kWireSize = detail::minimumSize<T, F>();

} // namespace posewire::wire
