// SPDX-License-Identifier: MIT
#include "core/wire/faults.h"

#include <array>
#include <cstddef>
#include <utility>

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

struct ErrorRow {
    ErrorCode code;
    std::string_view name;
    std::string_view text;
    std::string_view figures; ///< "#" for what is needed and for what is there
};

constexpr std::string_view kBytes = "needs # bytes, has #";

constexpr std::array<ErrorRow, kErrorCodeCount> kErrors{{
    {ErrorCode::HeaderTruncated, "headerTruncated", "the header is cut off", kBytes},
    {ErrorCode::BadMagic, "badMagic", "does not begin with \"MXTP\"", ""},
    {ErrorCode::BadType, "badType", "\"MXTP\" is not followed by two digits", ""},
    {ErrorCode::PayloadTruncated, "payloadTruncated", "shorter than its header announces", kBytes},
    {ErrorCode::ItemsTruncated, "itemsTruncated", "the announced items do not fit in the payload", kBytes},
    {ErrorCode::FieldTruncated, "fieldTruncated", "a field runs past the end", kBytes},
    {ErrorCode::BadLength, "badLength", "the length of a string is negative or leads past the end",
     "says # bytes, has #"},
    {ErrorCode::CountTooLarge, "countTooLarge",
     "a count is larger than the format allows or the rest of the datagram can hold",
     "says # items, has room for #"},
    {ErrorCode::BadSequence, "badSequence", "a string is not valid UTF-8", ""},
    {ErrorCode::UnterminatedText, "unterminatedText", "a string has no terminating zero", ""},
    {ErrorCode::TooLong, "tooLong", "longer than a datagram can be", "needs # bytes, has room for #"},
}};
static_assert(followTheEnum(kErrors));

struct NoticeRow {
    NoticeCode code;
    std::string_view name;
    std::string_view text;
    std::string_view counted; ///< what the count counts, in the plural; empty if it is always one
};

constexpr std::array<NoticeRow, kNoticeCodeCount> kNotices{{
    {NoticeCode::UnknownType, "unknownType", "message type not known, payload kept as bytes", ""},
    {NoticeCode::UnknownLayout, "unknownLayout", "type 04 in a layout that is not published, kept as bytes",
     ""},
    {NoticeCode::TrailingBytes, "trailingBytes", "bytes after the last field", "bytes"},
    {NoticeCode::SizeDisagrees, "sizeDisagrees", "longer than the payload size in the header", "bytes"},
    {NoticeCode::CountDisagrees, "countDisagrees",
     "body, props and fingers do not add up to the number of items", ""},
    {NoticeCode::ReservedUsed, "reservedUsed", "reserved header bytes are not zero", ""},
    {NoticeCode::NotFinite, "notFinite", "not a finite number", "values"},
    {NoticeCode::NotUnitQuaternion, "notUnitQuaternion", "quaternion is not of unit length", "quaternions"},
    {NoticeCode::SegmentOutOfRange, "segmentOutOfRange", "segment ID is not in 1 to 67", "segments"},
    {NoticeCode::UnknownTag, "unknownTag", "tag not known", "tags"},
    {NoticeCode::LineWithoutTag, "lineWithoutTag", "line that is not \"tag:value\"", "lines"},
    {NoticeCode::LengthDisagrees, "lengthDisagrees", "length before the time code is not 12", ""},
    {NoticeCode::NotATimeCode, "notATimeCode", "time code is not HH:MM:SS.mmm", ""},
}};
static_assert(followTheEnum(kNotices));

} // namespace

std::string_view errorName(ErrorCode code) {
    return kErrors[static_cast<std::size_t>(code)].name;
}

std::string errorText(const WireError& error) {
    const ErrorRow& row = kErrors[static_cast<std::size_t>(error.code)];
    if (error.code == ErrorCode::TooLong && error.need == 0) {
        return "a string that ends at a zero has a zero inside";
    }
    std::string text(row.text);
    text += " (byte " + std::to_string(error.offset) + (row.figures.empty() ? "" : ": ");
    // A length has a sign.
    const std::string need = error.code == ErrorCode::BadLength
                                 ? std::to_string(static_cast<std::int32_t>(error.need))
                                 : std::to_string(error.need);
    bool isFirst = true;
    for (const char letter : row.figures) {
        text += letter != '#'                   ? std::string(1, letter)
                : std::exchange(isFirst, false) ? need
                                                : std::to_string(error.have);
    }
    return text + ')';
}

std::string_view noticeName(NoticeCode code) {
    return kNotices[static_cast<std::size_t>(code)].name;
}

std::string noticeText(const Notice& notice) {
    const NoticeRow& row = kNotices[static_cast<std::size_t>(notice.code)];
    std::string text(row.text);
    text += " (byte " + std::to_string(notice.offset);
    if (!row.counted.empty()) {
        const std::size_t plural = notice.count == 1 ? 1 : 0; // the s
        text += ", " + std::to_string(notice.count) + ' ' +
                std::string(row.counted.substr(0, row.counted.size() - plural));
    }
    return text + ')';
}

} // namespace posewire::wire
