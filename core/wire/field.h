// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/types.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

/// The vocabulary in which layouts are declared. A layout is a tuple of fields; decoding, encoding, sizes,
/// the field tree, JSON and the protocol reference all walk that tuple, so that a field is written down once.
namespace posewire::wire {

/// The symbols are in type_table.cpp, in this order.
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

/// Symbol as shown to people, such as "m/s²"; empty if there is nothing to say.
std::string_view unitSymbol(Unit unit);

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

template <class M>
struct MemberOf;
template <class C, class M>
struct MemberOf<M C::*> {
    using Value = M;
};
template <auto Member>
using MemberValue = typename MemberOf<decltype(Member)>::Value;

// Each kind of field also says how many bytes it has at least; kIsValue: it always has that many.

/// A value of fixed size: an integer, a float, Vec3, Quat, Mat3 or an array of characters.
template <auto Member>
struct Field {
    static constexpr bool kIsValue = true;
    static constexpr std::size_t kLeastSize = sizeof(MemberValue<Member>);
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
    static constexpr bool kIsValue = false;
    /// Its length, or the zero that ends it.
    static constexpr std::size_t kLeastSize = std::array{4U, 1U, 0U}[static_cast<std::size_t>(Kind)];
    static constexpr auto kMember = Member;
    About about;
};

/// Items of one layout, as many as the header says ("number of items", §2.4.1.4); with Max, after a 32-bit
/// count of their own, at most Max.
template <auto Member, Form ItemForm = Form::Standard, std::size_t Max = 0>
struct Items {
    using Item = typename MemberValue<Member>::value_type;
    static constexpr Form kItemForm = ItemForm;
    static constexpr std::size_t kMax = Max;
    static constexpr bool kIsCounted = Max != 0;
    static constexpr bool kIsValue = false;
    static constexpr std::size_t kLeastSize = kIsCounted ? 4 : 0;
    static constexpr auto kMember = Member;
    About about;
};
template <auto Member, std::size_t Max>
using CountedList = Items<Member, Form::Standard, Max>;

/// The layout of each item and message, specialised as a tuple of fields; `false`: there is no such form.
template <class T, Form F = Form::Standard>
inline constexpr auto kLayout = false;
template <class T>
inline constexpr auto kLayout<T, Form::Standard> = T::needsALayout;

template <class T, Form F>
inline constexpr bool kHasForm = !std::is_same_v<decltype(kLayout<T, F>), const bool>;

/// Specialised for each message that has a second form: the bool that is false in it.
template <class T>
inline constexpr auto kIsStandard = nullptr;

/// Calls f(field) for each field of a layout, in wire order.
template <class T, Form F, class Function>
constexpr void forEachField(Function&& f) {
    std::apply([&](const auto&... field) { (f(field), ...); }, kLayout<T, F>);
}

/// Calls f(field) for the fields of a layout that are single values.
template <class T, Form F, class Function>
constexpr void forEachValue(Function&& f) {
    forEachField<T, F>([&]<class FieldType>(const FieldType& field) {
        if constexpr (FieldType::kIsValue) {
            f(field);
        }
    });
}

/// Calls f(field) for the lists of a layout.
template <class T, Form F, class Function>
constexpr void forEachList(Function&& f) {
    forEachField<T, F>([&]<class FieldType>(const FieldType& field) {
        if constexpr (requires { FieldType::kItemForm; }) {
            f(field);
        }
    });
}

/// True if every field has a fixed size.
template <class T, Form F = Form::Standard>
inline constexpr bool kIsFixed = std::apply([](const auto&... field) { return (field.kIsValue && ...); },
                                            kLayout<T, F>);

/// Bytes on the wire of a layout of fixed size; the least number of bytes for others.
template <class T, Form F = Form::Standard>
inline constexpr std::size_t
    kWireSize = std::apply([](const auto&... field) { return (field.kLeastSize + ...); }, kLayout<T, F>);

template <class V>
inline constexpr std::uint8_t kComponents = 1;
template <std::size_t N>
inline constexpr std::uint8_t kComponents<std::array<float, N>> = N;

template <class V>
inline constexpr Scalar kScalar = V::isNoValueOfTheWire;
template <>
inline constexpr Scalar kScalar<std::uint8_t> = Scalar::Uint8;
template <>
inline constexpr Scalar kScalar<std::uint16_t> = Scalar::Uint16;
template <>
inline constexpr Scalar kScalar<std::uint32_t> = Scalar::Uint32;
template <>
inline constexpr Scalar kScalar<std::int32_t> = Scalar::Int32;
template <>
inline constexpr Scalar kScalar<float> = Scalar::Float32;
template <std::size_t N>
inline constexpr Scalar kScalar<std::array<float, N>> = Scalar::Float32;
template <std::size_t N>
inline constexpr Scalar kScalar<std::array<char, N>> = Scalar::Characters;
template <>
inline constexpr Scalar kScalar<std::string> = Scalar::Text;

} // namespace posewire::wire
