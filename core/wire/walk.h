// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/byte_order.h"
#include "core/wire/faults.h"
#include "core/wire/field.h"
#include "core/wire/text.h"

#include <algorithm>

/// Reads values by walking their layouts. A visitor is shown every field and its place; decoding passes one
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

/// Takes no notice of anything. What a visitor is shown; `wantsCuts`: also the field for which the bytes did
/// not suffice, and what there is of an item that is cut off. `endGroup` ends a list or an item.
struct SilentVisitor {
    static constexpr bool wantsCuts() { return false; }
    void field(const About&, std::size_t, std::size_t, const auto&) {}
    void count(const About&, std::size_t, std::size_t) {}
    void cut(const About&, std::size_t, std::size_t, const WireError&) {}
    void beginList(const About&, std::size_t, std::size_t) {}
    void beginItem(std::size_t, std::size_t) {}
    void endGroup(std::size_t) {}
    void rest(std::size_t, std::size_t) {}
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
        visitor.field(field.about, cursor.offset + place, sizeof(value.*Member), value.*Member);
        place += sizeof(value.*Member);
    };
    forEachField<T, F>(readOne);
    cursor.offset += kWireSize<T, F>;
}

/// Shows the field that reading ended in; `claimed` bytes from `start` are the field's own. Always false.
template <class Visitor>
bool showCut(const Cursor& cursor, const About& about, std::size_t start, std::size_t claimed,
             Visitor& visitor) {
    if (visitor.wantsCuts()) {
        visitor.cut(about, start, std::min(claimed, cursor.bytes.size() - start), cursor.error);
    }
    return false;
}

template <auto Member, class T, class Visitor>
bool readField(Cursor& cursor, const Field<Member>& field, T& value, Visitor& visitor) {
    constexpr std::size_t size = sizeof(MemberValue<Member>);
    if (cursor.left() < size) {
        cursor.fail(ErrorCode::FieldTruncated, size, cursor.left());
        return showCut(cursor, field.about, cursor.offset, size, visitor);
    }
    loadValue(cursor.here(), value.*Member);
    visitor.field(field.about, cursor.offset, size, value.*Member);
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
        std::size_t claimed = cursor.bytes.size() - start;
        if (cursor.error.code == ErrorCode::BadLength) {
            claimed = 4;
        } else if (cursor.error.code == ErrorCode::BadSequence) {
            claimed = cursor.offset + 1 - start;
        }
        return showCut(cursor, field.about, start, claimed, visitor);
    }
    visitor.field(field.about, start, cursor.offset - start, value.*Member);
    return true;
}

/// Reads `count` items into `list`; what was read before a fault stays.
template <Form ItemForm, class Item, class Visitor>
bool readItems(Cursor& cursor, const About& about, std::size_t count, std::vector<Item>& list,
               Visitor& visitor) {
    visitor.beginList(about, cursor.offset, count);
    if constexpr (kIsFixed<Item, ItemForm>) {
        constexpr std::size_t size = kWireSize<Item, ItemForm>;
        if (count == 0 && cursor.left() >= size) {
            return cursor.fail(ErrorCode::NoItems, 0, cursor.left());
        }
        const std::size_t whole = std::min(count, cursor.left() / size);
        list.resize(whole);
        for (std::size_t i = 0; i < whole; ++i) {
            visitor.beginItem(i, cursor.offset);
            readFixed<Item, ItemForm>(cursor, list[i], visitor);
            visitor.endGroup(cursor.offset);
        }
        if (whole < count) {
            if (visitor.wantsCuts()) { // the fields that are there of the item that is cut off
                Cursor rest = cursor;
                Item item;
                visitor.beginItem(whole, rest.offset);
                readLayout<Item, ItemForm>(rest, item, visitor);
            }
            return cursor.fail(ErrorCode::ItemsTruncated, (count - whole) * size, cursor.left());
        }
    } else {
        list.clear();
        list.reserve(std::min(count, cursor.left() / kWireSize<Item, ItemForm>));
        for (std::size_t i = 0; i < count; ++i) {
            visitor.beginItem(i, cursor.offset);
            if (!readLayout<Item, ItemForm>(cursor, list.emplace_back(), visitor)) {
                return false;
            }
            visitor.endGroup(cursor.offset);
        }
    }
    visitor.endGroup(cursor.offset);
    return true;
}

template <auto Member, Form ItemForm, std::size_t Max, class T, class Visitor>
bool readField(Cursor& cursor, const Items<Member, ItemForm, Max>& field, T& value, Visitor& visitor) {
    using List = Items<Member, ItemForm, Max>;
    if constexpr (!List::kIsCounted) {
        return readItems<ItemForm>(cursor, field.about, cursor.items, value.*Member, visitor);
    }
    if (cursor.left() < 4) {
        cursor.fail(ErrorCode::FieldTruncated, 4, cursor.left());
        return showCut(cursor, field.about, cursor.offset, 4, visitor);
    }
    const std::uint32_t count = load32(cursor.here());
    const std::size_t room = std::min(Max, (cursor.left() - 4) / kWireSize<typename List::Item, ItemForm>);
    if (count > room) {
        cursor.fail(ErrorCode::CountTooLarge, count, room);
        if (count > Max || !visitor.wantsCuts()) {
            return showCut(cursor, field.about, cursor.offset, 4, visitor);
        }
    }
    // A count that the bytes cannot hold is the fault, but who wants cuts is shown the items that are there.
    const WireError fault = cursor.error;
    visitor.count(field.about, cursor.offset, count);
    cursor.offset += 4;
    const bool isRead = readItems<ItemForm>(cursor, field.about, count, value.*Member, visitor);
    if (count > room) {
        cursor.error = fault;
    }
    return isRead && count <= room;
}

} // namespace detail

/// Reads one value. False if the bytes do not suffice: cursor.error says what and where, and value and
/// visitor have everything up to the fault.
template <class T, Form F, class Visitor>
bool readLayout(Cursor& cursor, T& value, Visitor& visitor) {
    bool read = true;
    forEachField<T, F>(
        [&](const auto& field) { read = read && detail::readField(cursor, field, value, visitor); });
    return read;
}

} // namespace posewire::wire
