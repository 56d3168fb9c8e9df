// SPDX-License-Identifier: MIT
#include "core/wire/faults.h"

#include <array>
#include <cstddef>

namespace posewire::wire {
namespace {

template <class Row, std::size_t N>
constexpr bool followTheEnum(const std::array<Row, N>& rows) {
    for (std::size_t i = 0; i < N; ++i) {
        if (rows[i].code != static_cast<decltype(Row::code)>(i)) {
            return false;
        }
    }
    return true;
}

/// "{offset}", "{need}", "{have}" and "{count}" are figures of the fault.
struct ErrorRow {
    ErrorCode code;
    std::string_view name;
    const char* text;
};

constexpr std::array<ErrorRow, kErrorCodeCount> kErrors{{
    {ErrorCode::HeaderTruncated, "headerTruncated",
     "the header is cut off (byte {offset}: needs {need} bytes, has {have})"},
    {ErrorCode::BadMagic, "badMagic", "does not begin with \"MXTP\" (byte {offset})"},
    {ErrorCode::BadType, "badType", "\"MXTP\" is not followed by two digits (byte {offset})"},
    {ErrorCode::TypeAsNumber, "typeAsNumber",
     "type sent as a number: 0x0{need} 0x0{have} for \"{need}{have}\" (byte {offset})"},
    {ErrorCode::PayloadTruncated, "payloadTruncated",
     "shorter than its header announces (byte {offset}: needs {need} bytes, has {have})"},
    {ErrorCode::ItemsTruncated, "itemsTruncated",
     "the announced items do not fit in the payload (byte {offset}: needs {need} bytes, has {have})"},
    {ErrorCode::NoItems, "noItems", "the header announces no items (byte {offset}: {have} bytes follow)"},
    {ErrorCode::FieldTruncated, "fieldTruncated",
     "a field runs past the end (byte {offset}: needs {need} bytes, has {have})"},
    {ErrorCode::BadLength, "badLength",
     "the length of a string is negative or leads past the end (byte {offset}: says {need} bytes, has "
     "{have})"},
    {ErrorCode::CountTooLarge, "countTooLarge",
     "a count is larger than the format allows or the rest of the datagram can hold (byte {offset}: says "
     "{need} items, has room for {have})"},
    {ErrorCode::BadSequence, "badSequence", "a string is not valid UTF-8 (byte {offset})"},
    {ErrorCode::UnterminatedText, "unterminatedText", "a string has no terminating zero (byte {offset})"},
    {ErrorCode::TooLong, "tooLong",
     "longer than a datagram can be (byte {offset}: needs {need} bytes, has room for {have})"},
}};
static_assert(followTheEnum(kErrors));

struct NoticeRow {
    NoticeCode code;
    std::string_view name;
    const char* text;
    const char* one = nullptr;
};

constexpr std::array<NoticeRow, kNoticeCodeCount> kNotices{{
    {NoticeCode::UnknownType, "unknownType", "message type not known, payload kept as bytes (byte {offset})"},
    {NoticeCode::UnknownLayout, "unknownLayout",
     "type 04 in a layout that is not published, kept as bytes (byte {offset})"},
    {NoticeCode::TrailingBytes, "trailingBytes", "bytes after the last field (byte {offset}, {count} bytes)",
     "bytes after the last field (byte {offset}, {count} byte)"},
    {NoticeCode::SizeDisagrees, "sizeDisagrees",
     "longer than the payload size in the header (byte {offset}, {count} bytes)",
     "longer than the payload size in the header (byte {offset}, {count} byte)"},
    {NoticeCode::CountDisagrees, "countDisagrees",
     "body, props and fingers do not add up to the number of items (byte {offset})"},
    {NoticeCode::ReservedUsed, "reservedUsed", "reserved header bytes are not zero (byte {offset})"},
    {NoticeCode::NotFinite, "notFinite", "not a finite number (byte {offset}, {count} values)",
     "not a finite number (byte {offset}, {count} value)"},
    {NoticeCode::NotUnitQuaternion, "notUnitQuaternion",
     "quaternion is not of unit length (byte {offset}, {count} quaternions)",
     "quaternion is not of unit length (byte {offset}, {count} quaternion)"},
    {NoticeCode::SegmentOutOfRange, "segmentOutOfRange",
     "segment ID is not in 1 to 67 (byte {offset}, {count} segments)",
     "segment ID is not in 1 to 67 (byte {offset}, {count} segment)"},
    {NoticeCode::UnknownTag, "unknownTag", "tag not known (byte {offset}, {count} tags)",
     "tag not known (byte {offset}, {count} tag)"},
    {NoticeCode::LineWithoutTag, "lineWithoutTag",
     "line that is not \"tag:value\" (byte {offset}, {count} lines)",
     "line that is not \"tag:value\" (byte {offset}, {count} line)"},
    {NoticeCode::LengthDisagrees, "lengthDisagrees", "length before the time code is not 12 (byte {offset})"},
    {NoticeCode::NotATimeCode, "notATimeCode", "time code is not HH:MM:SS.mmm (byte {offset})"},
    {NoticeCode::BadColour, "badColour", "colour is not six hexadecimal digits (byte {offset}; § 2.6.3)"},
    {NoticeCode::TooManyProps, "tooManyProps",
     "{count} props, at most 4 are specified (byte {offset}; § 2.5.2)"},
    {NoticeCode::TooManyItems, "tooManyItems",
     "{count} segments, exactly 23 are specified for type 05 (byte {offset}; § 2.5.5)"},
    {NoticeCode::TooManyPoints, "tooManyPoints",
     "{count} points, marker sets have up to 64 (byte {offset}; § 2.4.1.1)"},
}};
static_assert(followTheEnum(kNotices));

void fill(std::string& text, std::string_view name, std::int64_t figure) {
    for (std::size_t at = 0; (at = text.find(name, at)) != std::string::npos;) {
        text.replace(at, name.size(), std::to_string(figure));
    }
}

} // namespace

std::string inEnglish(const char* text, const char* one, std::uint32_t number) {
    return one != nullptr && number == 1 ? one : text;
}

std::string_view errorName(ErrorCode code) {
    return kErrors[static_cast<std::size_t>(code)].name;
}

std::string errorText(const WireError& error, FaultLanguage language) {
    const bool isZeroInside = error.code == ErrorCode::TooLong && error.need == 0;
    std::string text = language(isZeroInside ? "a string that ends at a zero has a zero inside"
                                             : kErrors[static_cast<std::size_t>(error.code)].text,
                                nullptr, error.need);
    fill(text, "{offset}", error.offset);
    // A length has a sign.
    fill(text, "{need}",
         error.code == ErrorCode::BadLength ? std::int64_t{static_cast<std::int32_t>(error.need)}
                                            : std::int64_t{error.need});
    fill(text, "{have}", error.have);
    return text;
}

std::string_view noticeName(NoticeCode code) {
    return kNotices[static_cast<std::size_t>(code)].name;
}

std::string noticeText(const Notice& notice, FaultLanguage language) {
    const NoticeRow& row = kNotices[static_cast<std::size_t>(notice.code)];
    std::string text = language(row.text, row.one, notice.count);
    fill(text, "{offset}", notice.offset);
    fill(text, "{count}", notice.count);
    return text;
}

} // namespace posewire::wire
