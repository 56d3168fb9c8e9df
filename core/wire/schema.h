// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/field.h"

/// The layouts as plain data, made from them once: for who lists what is declared rather than reads bytes.
namespace posewire::wire {

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
    std::size_t size = 0;              ///< bytes of a value, or of each item; 0 where it varies
    std::size_t least = 0;             ///< bytes that each item has at least
    std::size_t max = 0;               ///< of CountedItems
    std::span<const FieldRow> items{}; ///< fields of each item

    [[nodiscard]] constexpr bool isList() const { return kind == Kind::Items || kind == Kind::CountedItems; }
};

/// One layout of a message.
struct FormRow {
    Form form = Form::Standard;
    std::size_t size = 0; ///< bytes of the payload; 0 where it varies
    std::span<const FieldRow> fields;
};

/// A message type in all its forms, the standard one first.
struct MessageRow {
    std::uint8_t type = 0;
    std::span<const FormRow> forms;

    [[nodiscard]] constexpr std::span<const FieldRow> fields() const { return forms.front().fields; }
};

/// All message types, in order.
[[nodiscard]] std::span<const MessageRow> messageRows();
/// Null where the type is not known.
[[nodiscard]] const MessageRow* findMessage(std::uint8_t type);

/// The fields of the header.
[[nodiscard]] std::span<const FieldRow> headerRows();

/// True for types whose items are about segments, in whichever order.
[[nodiscard]] bool listsSegments(std::uint8_t type);

/// True for types whose items are the segments that the header counts: body, props and fingers.
[[nodiscard]] bool countsSegments(std::uint8_t type);

} // namespace posewire::wire
