// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/byte_order.h"
#include "core/wire/error.h"
#include "core/wire/field.h"
#include "core/wire/utf8.h"

#include <algorithm>

/// Reads values by walking their layouts. A visitor hears of every field and its place; decoding passes one
/// that does nothing, the field tree one that writes everything down, so that both always agree.
namespace posewire::wire {

/// Reading position in one datagram, and the fault that ended reading.
struct Cursor {
    Bytes bytes;             ///< the whole datagram
    std::size_t offset = 0;  ///< from the datagram's first byte
    std::uint32_t items = 0; ///< the header's number of items
    WireError error;

    [[nodiscard]] std::size_t left() const { return bytes.size() - offset; }
    [[nodiscard]] const std::byte* here() const { return bytes.data() + offset; }

    /// Notes the fault; always false, so that `return cursor.fail(…)` ends a read.
    bool fail(ErrorCode code, std::size_t need, std::size_t have) {
        error = {code, error.type, static_cast<std::uint32_t>(offset), static_cast<std::uint32_t>(need),
                 static_cast<std::uint32_t>(have)};
        return false;
    }
};

/// Hears nothing.
struct SilentVisitor {
    static constexpr bool kListens = false;
};

/// A visitor that also wants to know which field the bytes did not suffice for, and what there is of an item
/// that is cut off.
template <class Visitor>
concept HearsCuts = requires(Visitor& visitor, const About& about, const WireError& error) {
    visitor.cut(about, std::size_t{}, std::size_t{}, error);
};

template <class T, Form F, class Visitor>
bool readLayout(Cursor& cursor, T& value, Visitor& visitor);

namespace detail {

/// Reads a layout of fixed size; the caller has made sure of the room.
template <class T, Form F, class Visitor>
void readFixed(Cursor& cursor, T& value, Visitor& visitor) {
    const std::byte* from = cursor.here();
    std::size_t place = 0;
    const auto readOne = [&]<auto Member>(const Field<Member>& field) {
        loadValue(from + place, value.*Member);
        if constexpr (Visitor::kListens) {
            visitor.field(field.about, cursor.offset + place, sizeof(value.*Member), value.*Member);
        }
        place += sizeof(value.*Member);
    };
    forEachField<T, F>(readOne);
    cursor.offset += kWireSize<T, F>;
}

/// Tells of the field that reading ended in; `claimed` bytes from `start` are the field's own. Always false.
template <class Visitor>
bool tellCut(const Cursor& cursor, const About& about, std::size_t start, std::size_t claimed,
             Visitor& visitor) {
    if constexpr (HearsCuts<Visitor>) {
        visitor.cut(about, start, std::min(claimed, cursor.bytes.size() - start), cursor.error);
    }
    return false;
}

template <auto Member, class T, class Visitor>
bool readField(Cursor& cursor, const Field<Member>& field, T& value, Visitor& visitor) {
    constexpr std::size_t size = sizeof(MemberValue<Member>);
    if (cursor.left() < size) {
        cursor.fail(ErrorCode::FieldTruncated, size, cursor.left());
        return tellCut(cursor, field.about, cursor.offset, size, visitor);
    }
    loadValue(cursor.here(), value.*Member);
    if constexpr (Visitor::kListens) {
        visitor.field(field.about, cursor.offset, size, value.*Member);
    }
    cursor.offset += size;
    return true;
}

inline bool takeText(Cursor& cursor, std::size_t length, std::string& text) {
    const std::string_view characters(reinterpret_cast<const char*>(cursor.here()), length);
    if (const std::size_t bad = firstInvalidUtf8(characters); bad != characters.size()) {
        cursor.offset += bad;
        return cursor.fail(ErrorCode::BadSequence, 0, 0);
    }
    text.assign(characters);
    cursor.offset += length;
    return true;
}

inline bool readText(Cursor& cursor, TextKind kind, std::string& text) {
    if (kind == TextKind::ToEnd) {
        return takeText(cursor, cursor.left(), text);
    }
    if (kind == TextKind::ZeroTerminated) {
        const std::byte* end = std::find(cursor.here(), cursor.here() + cursor.left(), std::byte{0});
        const auto length = static_cast<std::size_t>(end - cursor.here());
        if (length == cursor.left()) {
            return cursor.fail(ErrorCode::UnterminatedText, 1, 0);
        }
        const bool read = takeText(cursor, length, text);
        cursor.offset += read ? 1 : 0;
        return read;
    }
    if (cursor.left() < 4) {
        return cursor.fail(ErrorCode::FieldTruncated, 4, cursor.left());
    }
    const auto length = static_cast<std::int32_t>(load32(cursor.here()));
    if (length < 0 || static_cast<std::size_t>(length) > cursor.left() - 4) {
        return cursor.fail(ErrorCode::BadLength, static_cast<std::uint32_t>(length), cursor.left() - 4);
    }
    cursor.offset += 4;
    return takeText(cursor, static_cast<std::size_t>(length), text);
}

template <auto Member, TextKind Kind, class T, class Visitor>
bool readField(Cursor& cursor, const Text<Member, Kind>& field, T& value, Visitor& visitor) {
    const std::size_t start = cursor.offset;
    if (!readText(cursor, Kind, value.*Member)) {
        // Of a text that runs past the end only its length is certain; of others what was looked at.
        const bool isLength = cursor.error.code == ErrorCode::BadLength;
        const bool isSequence = cursor.error.code == ErrorCode::BadSequence;
        const std::size_t claimed = isLength     ? 4
                                    : isSequence ? cursor.offset + 1 - start
                                                 : cursor.bytes.size() - start;
        return tellCut(cursor, field.about, start, claimed, visitor);
    }
    if constexpr (Visitor::kListens) {
        visitor.field(field.about, start, cursor.offset - start, value.*Member);
    }
    return true;
}

/// Shows the fields that are there of an item that is cut off.
template <class Item, Form F, class Visitor>
void tellPartOfItem(Cursor cursor, std::size_t index, Visitor& visitor) {
    Item item;
    visitor.beginItem(index, cursor.offset);
    readLayout<Item, F>(cursor, item, visitor);
}

/// Reads `count` items into `list`; what was read before a fault stays.
template <Form ItemForm, class Item, class Visitor>
bool readItems(Cursor& cursor, const About& about, std::size_t count, std::vector<Item>& list,
               Visitor& visitor) {
    if constexpr (Visitor::kListens) {
        visitor.beginList(about, cursor.offset, count);
    }
    if constexpr (kIsFixed<Item, ItemForm>) {
        constexpr std::size_t size = kWireSize<Item, ItemForm>;
        const std::size_t whole = std::min(count, cursor.left() / size);
        list.resize(whole);
        for (std::size_t i = 0; i < whole; ++i) {
            if constexpr (Visitor::kListens) {
                visitor.beginItem(i, cursor.offset);
            }
            readFixed<Item, ItemForm>(cursor, list[i], visitor);
            if constexpr (Visitor::kListens) {
                visitor.endItem(cursor.offset);
            }
        }
        if (whole < count) {
            if constexpr (HearsCuts<Visitor>) {
                tellPartOfItem<Item, ItemForm>(cursor, whole, visitor);
            }
            return cursor.fail(ErrorCode::ItemsTruncated, (count - whole) * size, cursor.left());
        }
    } else {
        list.clear();
        list.reserve(std::min(count, cursor.left() / kWireSize<Item, ItemForm>));
        for (std::size_t i = 0; i < count; ++i) {
            if constexpr (Visitor::kListens) {
                visitor.beginItem(i, cursor.offset);
            }
            if (!readLayout<Item, ItemForm>(cursor, list.emplace_back(), visitor)) {
                return false;
            }
            if constexpr (Visitor::kListens) {
                visitor.endItem(cursor.offset);
            }
        }
    }
    if constexpr (Visitor::kListens) {
        visitor.endList(cursor.offset);
    }
    return true;
}

template <auto Member, Form ItemForm, class T, class Visitor>
bool readField(Cursor& cursor, const Items<Member, ItemForm>& field, T& value, Visitor& visitor) {
    return readItems<ItemForm>(cursor, field.about, cursor.items, value.*Member, visitor);
}

/// A count that the bytes cannot hold is the fault; who wants to see all there is hears the items up to where
/// the bytes end, provided that the count could be meant. Always false.
template <auto Member, std::size_t Max, class T, class Visitor>
bool tellItemsThatAreThere(Cursor& cursor, const CountedList<Member, Max>& field, std::uint32_t count,
                           T& value, Visitor& visitor) {
    if constexpr (HearsCuts<Visitor>) {
        if (count <= Max) {
            const WireError fault = cursor.error;
            visitor.count(field.about, cursor.offset, count);
            cursor.offset += 4;
            readItems<Form::Standard>(cursor, field.about, count, value.*Member, visitor);
            cursor.error = fault;
            return false;
        }
    }
    return tellCut(cursor, field.about, cursor.offset, 4, visitor);
}

template <auto Member, std::size_t Max, class T, class Visitor>
bool readField(Cursor& cursor, const CountedList<Member, Max>& field, T& value, Visitor& visitor) {
    using Item = typename MemberValue<Member>::value_type;
    if (cursor.left() < 4) {
        cursor.fail(ErrorCode::FieldTruncated, 4, cursor.left());
        return tellCut(cursor, field.about, cursor.offset, 4, visitor);
    }
    const std::uint32_t count = load32(cursor.here());
    const std::size_t room = std::min(Max, (cursor.left() - 4) / kWireSize<Item>);
    if (count > room) {
        cursor.fail(ErrorCode::CountTooLarge, count, room);
        return tellItemsThatAreThere(cursor, field, count, value, visitor);
    }
    if constexpr (Visitor::kListens) {
        visitor.count(field.about, cursor.offset, count);
    }
    cursor.offset += 4;
    return readItems<Form::Standard>(cursor, field.about, count, value.*Member, visitor);
}

} // namespace detail

/// Reads one value. False where the bytes do not suffice: cursor.error says what and where, and value and
/// visitor have everything up to the fault.
template <class T, Form F, class Visitor>
bool readLayout(Cursor& cursor, T& value, Visitor& visitor) {
    bool read = true;
    forEachField<T, F>(
        [&](const auto& field) { read = read && detail::readField(cursor, field, value, visitor); });
    return read;
}

} // namespace posewire::wire
