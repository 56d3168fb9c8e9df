// SPDX-License-Identifier: MIT
#include "core/wire/error.h"

#include <array>
#include <cstddef>

namespace posewire::wire {
namespace {

struct ErrorRow {
    ErrorCode code;
    std::string_view name;
    std::string_view text;
    std::string_view measure; ///< what need and have count
};

constexpr std::array<ErrorRow, kErrorCodeCount> kErrors{{
    {ErrorCode::HeaderTruncated, "headerTruncated", "the header is cut off", "bytes"},
    {ErrorCode::BadMagic, "badMagic", "does not begin with \"MXTP\"", ""},
    {ErrorCode::BadType, "badType", "\"MXTP\" is not followed by two digits", ""},
    {ErrorCode::PayloadTruncated, "payloadTruncated", "shorter than its header announces", "bytes"},
    {ErrorCode::ItemsTruncated, "itemsTruncated", "the announced items do not fit in the payload", "bytes"},
    {ErrorCode::FieldTruncated, "fieldTruncated", "a field runs past the end", "bytes"},
    {ErrorCode::BadLength, "badLength", "a string runs past the end or its length is negative", "bytes"},
    {ErrorCode::CountTooLarge, "countTooLarge", "a count is larger than the rest of the datagram can hold",
     "items"},
    {ErrorCode::BadSequence, "badSequence", "a string is not valid UTF-8", ""},
    {ErrorCode::UnterminatedText, "unterminatedText", "a string has no terminating zero", ""},
    {ErrorCode::TooLong, "tooLong", "longer than a datagram or one of its fields can be", "bytes"},
}};

constexpr bool rowsFollowTheEnum() {
    for (std::size_t i = 0; i < kErrors.size(); ++i) {
        if (kErrors[i].code != static_cast<ErrorCode>(i)) {
            return false;
        }
    }
    return true;
}
static_assert(rowsFollowTheEnum());

} // namespace

std::string_view errorName(ErrorCode code) {
    return kErrors[static_cast<std::size_t>(code)].name;
}

std::string errorText(const WireError& error) {
    const ErrorRow& row = kErrors[static_cast<std::size_t>(error.code)];
    std::string text(row.text);
    text += " (byte " + std::to_string(error.offset);
    if (!row.measure.empty()) {
        text += ": needs " + std::to_string(error.need) + ' ' + std::string(row.measure) + ", has " +
                std::to_string(error.have);
    }
    return text + ')';
}

} // namespace posewire::wire
