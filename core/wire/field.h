// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/types.h"

#include <concepts>
#include <cstdint>
#include <span>
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
    Reserved,  ///< means nothing, should be zero
    TagLines,  ///< a text of one "tag:value" a line
    TimeOfDay, ///< "HH:MM:SS.mmm"
};

/// Symbol as shown to people, such as "m/s²"; empty where there is nothing to say.
std::string_view unitSymbol(Unit unit);

/// What a number names, or what the items of a list are about.
enum class RefersTo : std::uint8_t {
    Nothing,
    Character,
    Segment,      ///< in the order of §2.5.9: body, props, left hand, right hand
    UnitySegment, ///< in the order of §2.5.5
    Tracker,      ///< by the segment that carries it
    Carrier,      ///< the segment of the null pose that carries a point
    Point,        ///< a point of a segment: 256 × segment + point, 100 × in older revisions
    LocalPoint,   ///< a point within its segment
    JointEnd,     ///< a point of a segment: 256 × segment + point; of a joint the child comes last
    Joint,
    Prop, ///< by its segment
    Tag,
};

/// A part of a field that means something by itself: some of its characters, or some of its bits.
struct FieldPart {
    std::string_view name;
    std::string_view key; ///< in JSON, where the parts replace the field; empty for a part that is left out
    Unit unit = Unit::None;
    std::string_view text;
    std::uint8_t offset = 0; ///< bytes from the field's first
    std::uint8_t size = 1;   ///< bytes
    std::uint8_t bits = 0;   ///< mask of a part of a byte; 0 for characters

    [[nodiscard]] constexpr bool isFlag() const { return bits != 0 && (bits & (bits - 1)) == 0; }
};

/// What a field is for people: the JSON key, its unit, one line, where the specification defines it, and what
/// it refers to.
struct About {
    std::string_view name;
    Unit unit = Unit::None;
    std::string_view text;
    std::string_view section;
    RefersTo refersTo = RefersTo::Nothing;
    std::span<const FieldPart> parts{};
};

/// What a value is made of, deduced from the member's type.
enum class Scalar : std::uint8_t { Uint8, Uint16, Uint32, Int32, Float32, Characters, Text };

/// "uint8", "float32", "characters", "text".
std::string_view scalarName(Scalar scalar);

/// How the components of a vector (3), quaternion (4) or matrix (9) are called; empty for other numbers.
std::span<const std::string_view> componentNames(std::size_t components);

/// Some messages come in more than one layout; the form names it. core/wire/form.h finds out which one
/// bytes are in.
enum class Form : std::uint8_t {
    Standard, ///< as the specification's newest revision that has the type
    Short,    ///< type 23 with 44 bytes an item, type 24 with the position alone
    Bare,     ///< type 12 and 25 without length prefix
    Unity,    ///< type 05: the item of type 02 in another frame
    Raw,      ///< kept as bytes: unknown type, or a type 04 that is not the one of revision E
};

/// A value of fixed size: an integer, a float, Vec3, Quat, Mat3 or an array of characters.
template <auto Member>
struct Field {
    static constexpr bool kIsValue = true;
    static constexpr auto kMember = Member;
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
    static constexpr TextKind kKind = Kind;
    static constexpr auto kMember = Member;
    About about;
};

/// Items of one layout whose number the header gives ("number of items", §2.4.1.4).
template <auto Member, Form ItemForm = Form::Standard>
struct Items {
    static constexpr Form kItemForm = ItemForm;
    static constexpr auto kMember = Member;
    About about;
};

/// Items of one layout after a 32-bit count of their own, at most Max.
template <auto Member, std::size_t Max>
struct CountedList {
    static constexpr Form kItemForm = Form::Standard;
    static constexpr std::size_t kMax = Max;
    static constexpr auto kMember = Member;
    About about;
};

/// Specialised for each item and message: `static constexpr auto fields = std::tuple{…}`. The layout of
/// another form of a message also names the bool that is false in it: `static constexpr auto isStandard`.
template <class T, Form F = Form::Standard>
struct Layout;

template <class T, Form F>
inline constexpr bool kHasForm = requires {
    Layout<T, F>::fields;
};

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

/// Calls f(field) for the fields of a layout that are single values.
template <class T, Form F, class Function>
constexpr void forEachValue(Function&& f) {
    forEachField<T, F>([&]<class FieldType>(const FieldType& field) {
        if constexpr (requires { FieldType::kIsValue; }) {
            f(field);
        }
    });
}

/// Calls f.template operator()<ItemForm>(field) for the lists of a layout.
template <class T, Form F, class Function>
constexpr void forEachList(Function&& f) {
    forEachField<T, F>([&]<class FieldType>(const FieldType& field) {
        if constexpr (requires { FieldType::kItemForm; }) {
            f.template operator()<FieldType::kItemForm>(field);
        }
    });
}

namespace detail {

template <class V>
constexpr Scalar scalarOf(std::type_identity<V>) {
    if constexpr (std::same_as<V, std::uint8_t>) {
        return Scalar::Uint8;
    } else if constexpr (std::same_as<V, std::uint16_t>) {
        return Scalar::Uint16;
    } else if constexpr (std::same_as<V, std::uint32_t>) {
        return Scalar::Uint32;
    } else if constexpr (std::same_as<V, std::int32_t>) {
        return Scalar::Int32;
    } else if constexpr (std::same_as<V, float>) {
        return Scalar::Float32;
    } else {
        static_assert(std::same_as<V, std::string>, "no such value on the wire");
        return Scalar::Text;
    }
}
template <std::size_t N>
constexpr Scalar scalarOf(std::type_identity<std::array<float, N>>) {
    return Scalar::Float32;
}
template <std::size_t N>
constexpr Scalar scalarOf(std::type_identity<std::array<char, N>>) {
    return Scalar::Characters;
}

template <class V>
inline constexpr std::uint8_t kComponents = 1;
template <std::size_t N>
inline constexpr std::uint8_t kComponents<std::array<float, N>> = N;

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

/// What the type of a member is on the wire, and how many of it there are (3 for Vec3).
template <class V>
inline constexpr Scalar kScalar = detail::scalarOf(std::type_identity<V>{});
template <class V>
inline constexpr std::uint8_t kComponents = detail::kComponents<V>;

} // namespace posewire::wire
