// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/field.h"

namespace posewire::wire {

/// Axes and hand of a type's coordinates.
enum class Frame : std::uint8_t {
    None,
    ZUp,   ///< Z-up, right-handed
    YUp,   ///< Y-up, right-handed
    Unity, ///< Y-up, left-handed
    Isb,   ///< ISB axes of a joint
};

/// "Z-up, right-handed"; empty for none.
[[nodiscard]] std::string_view frameName(Frame frame);

// The layouts as plain data, made from them once: for who lists what is declared rather than reads bytes.

/// One declared field.
struct FieldRow {
    enum class Kind : std::uint8_t {
        Value,        ///< of fixed size
        Text,         ///< as `textKind` says
        Items,        ///< as many as the header announces
        CountedItems, ///< after a count of their own, at most `max`
    };
    About about;
    Kind kind = Kind::Value;
    Scalar scalar = Scalar::Text;
    TextKind textKind = TextKind::Prefixed;
    std::uint8_t components = 1;       ///< of a value: 3 of a vector
    std::size_t size = 0;              ///< bytes of a value, or of each item; 0 if it varies
    std::size_t least = 0;             ///< bytes that each item has at least
    std::size_t max = 0;               ///< of CountedItems
    std::span<const FieldRow> items{}; ///< fields of each item

    [[nodiscard]] constexpr bool isList() const { return kind == Kind::Items || kind == Kind::CountedItems; }
};

/// One layout of a message.
struct FormRow {
    Form form = Form::Standard;
    std::size_t size = 0; ///< bytes of the payload; 0 if it varies
    std::span<const FieldRow> fields;
};

/// What people call a message type, what the specification says about it as a whole, and its layouts.
struct TypeInfo {
    std::string_view name; ///< "Pose, quaternion"
    Frame frame;
    std::string_view revisions; ///< "E–N": of the specification, the first and the last that have it
    std::string_view section;
    std::string_view remark{};        ///< where real senders and the text differ
    bool isSampled = true;            ///< carries a sample counter that counts frames (not types 10 to 13)
    std::uint8_t type = 0;            ///< as the message has it
    std::span<const FormRow> forms{}; ///< from its layouts, the standard one first

    [[nodiscard]] constexpr std::span<const FieldRow> fields() const { return forms.front().fields; }
    [[nodiscard]] constexpr char firstRevision() const { return revisions.front(); }
    [[nodiscard]] constexpr bool isInOneRevision() const { return revisions.size() == 1; }
};

/// The row of a message type, specialised for each of wire::Messages; type and forms come from there.
template <class Message>
inline constexpr TypeInfo kRow = Message::needsARowInTheTypeTable;

/// All message types, in order.
[[nodiscard]] std::span<const TypeInfo> typeTable();

/// The row of a type; null if the type is not known.
[[nodiscard]] const TypeInfo* findType(std::uint8_t type);

/// The type as the two digits on the wire, "02".
[[nodiscard]] std::string typeDigits(std::uint8_t type);

/// "02 Pose, quaternion", or "77 unknown type".
[[nodiscard]] std::string typeTitle(std::uint8_t type);

/// True for types whose sample counter counts frames; unknown types are taken to.
[[nodiscard]] bool isSampled(std::uint8_t type);

/// The fields of the header.
[[nodiscard]] std::span<const FieldRow> headerRows();

/// True for types whose items are about segments, in whichever order.
[[nodiscard]] bool listsSegments(std::uint8_t type);

/// True for types whose items are the segments that the header counts: body, props and fingers.
[[nodiscard]] bool countsSegments(std::uint8_t type);

} // namespace posewire::wire
