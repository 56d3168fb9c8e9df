// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/codec.h"
#include "core/wire/form.h"
#include "core/wire/walk.h"

namespace posewire::wire {

/// A cursor at the payload that ends where the datagram or the announced payload ends, whichever comes first.
[[nodiscard]] inline Cursor payloadCursor(Bytes bytes, const Header& header) {
    const std::size_t announced = kHeaderSize + sentPayload(header, bytes.subspan(kHeaderSize));
    const std::size_t end = header.payloadSize != 0 ? std::min(bytes.size(), announced) : bytes.size();
    Cursor cursor{bytes.first(end), kHeaderSize, header.items, {}};
    cursor.error.type = header.type();
    return cursor;
}

namespace detail {

template <class Visitor>
bool readRaw(Cursor& cursor, Datagram& into, NoticeCode why, Visitor& visitor) {
    auto* kept = std::get_if<RawBody>(&into.body);
    RawBody& raw = kept != nullptr ? *kept : into.body.emplace<RawBody>();
    raw.bytes.assign(cursor.here(), cursor.here() + cursor.left());
    visitor.rest(cursor.offset, cursor.left());
    cursor.offset = cursor.bytes.size();
    into.notices.push_back(
        {why, why == NoticeCode::UnknownType ? 4U : static_cast<std::uint32_t>(kHeaderSize), 1});
    return true;
}

} // namespace detail

/// Reads the body that into.header announces. False with cursor.error if it cannot be read.
template <class Visitor>
bool readBody(Cursor& cursor, Datagram& into, Visitor& visitor) {
    const std::uint8_t type = into.header.type();
    const Form form = formOf(into.header, cursor.bytes.subspan(kHeaderSize));
    const std::size_t announced = kHeaderSize + into.header.payloadSize;
    const bool isCutOff = into.header.payloadSize != 0 && cursor.bytes.size() < announced;
    const auto failCutOff = [&] {
        cursor.offset = cursor.bytes.size();
        return cursor.fail(ErrorCode::PayloadTruncated, announced, cursor.bytes.size());
    };
    if (form == Form::Raw) {
        return detail::readRaw(cursor, into, NoticeCode::UnknownLayout, visitor) &&
               (!isCutOff || failCutOff());
    }
    bool read = false;
    const bool isKnown = withMessage(into.body, type, [&]<class T>(T& value) {
        setForm(value, form);
        read = withForm<T>(form, [&]<Form F>() { return readLayout<T, F>(cursor, value, visitor); });
    });
    if (!isKnown) {
        return detail::readRaw(cursor, into, NoticeCode::UnknownType, visitor) && (!isCutOff || failCutOff());
    }
    if (isCutOff) {
        return failCutOff();
    }
    if (read && cursor.left() != 0) {
        into.notices.push_back({NoticeCode::TrailingBytes, static_cast<std::uint32_t>(cursor.offset),
                                static_cast<std::uint32_t>(cursor.left())});
        visitor.rest(cursor.offset, cursor.left());
    }
    return read;
}

/// Appends a notice for whatever is odd in the values of a datagram that has been read from `bytes`.
void checkValues(Bytes bytes, Datagram& datagram);

} // namespace posewire::wire
