// SPDX-License-Identifier: MIT
#pragma once

#include <tl/expected.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

/// What is wrong with a datagram that cannot be read, and what is odd about one that can.
namespace posewire::wire {

/// Why bytes cannot be read as a datagram. The texts are in faults.cpp, one for each, in this order.
enum class ErrorCode : std::uint8_t {
    HeaderTruncated,  ///< fewer than 24 bytes
    BadMagic,         ///< does not begin with "MXTP"
    BadType,          ///< "MXTP" is not followed by two digits
    TypeAsNumber,     ///< two bytes below 10 in place of two digits
    PayloadTruncated, ///< the header announces more bytes than there are
    ItemsTruncated,   ///< the announced items do not fit in the bytes that are there
    NoItems,          ///< the header announces none, and bytes of items follow
    FieldTruncated,   ///< a field runs past the end
    BadLength,        ///< a string length is negative or runs past the end
    CountTooLarge,    ///< a count exceeds its maximum or what the remaining bytes can hold
    BadSequence,      ///< a string is not UTF-8
    UnterminatedText, ///< a zero-terminated string has no zero
    TooLong,          ///< longer than any UDP datagram, or a value that its field cannot hold (when encoding)
};

inline constexpr std::size_t kErrorCodeCount = 13;

/// A fault in one datagram. Offsets and sizes are bytes from the datagram's first byte.
struct WireError {
    ErrorCode code = ErrorCode::HeaderTruncated;
    std::uint8_t type = 0;    ///< message type (decimal digits read as a number), 0 if not known
    std::uint32_t offset = 0; ///< where the fault arose
    std::uint32_t need = 0;   ///< what would have been needed there (bytes, or the maximum of a count)
    std::uint32_t have = 0;   ///< what was there

    friend bool operator==(const WireError&, const WireError&) = default;
};
static_assert(std::is_trivially_copyable_v<WireError>);

template <class T>
using Result = tl::expected<T, WireError>;

/// A text of the tables in some language, in the singular if it has one and the number is 1.
using FaultLanguage = std::string (*)(const char* text, const char* one, std::uint32_t number);
std::string inEnglish(const char* text, const char* one, std::uint32_t number);

/// Stable name for files and scripts, such as "payloadTruncated".
std::string_view errorName(ErrorCode code);

/// One sentence for a person: what is wrong, where, and how much was needed.
std::string errorText(const WireError& error, FaultLanguage language = inEnglish);

/// What is odd about a datagram that could be read all the same. The texts are in faults.cpp, in this order.
enum class NoticeCode : std::uint8_t {
    UnknownType,       ///< kept as bytes
    UnknownLayout,     ///< type 04 of newer programs, kept as bytes
    TrailingBytes,     ///< bytes after the last field
    SizeDisagrees,     ///< the datagram is longer than its header announces
    CountDisagrees,    ///< body + props + fingers is not the number of items
    ReservedUsed,      ///< header bytes 20–21 are not zero
    NotFinite,         ///< NaN or infinity
    NotUnitQuaternion, ///< length differs from 1 by more than 0.01
    SegmentOutOfRange, ///< a segment id of 0 or above 67
    UnknownTag,        ///< type 12: a tag that is neither specified nor seen on real wires
    LineWithoutTag,    ///< type 12: a line without ':' or without an end
    LengthDisagrees,   ///< type 25: the length before the string is not 12
    NotATimeCode,      ///< type 25: not HH:MM:SS.mmm
    BadColour,         ///< type 12: a colour that is not six hexadecimal digits
    TooManyProps,      ///< more than four
    TooManyItems,      ///< type 05: more than 23 segments
    TooManyPoints,     ///< type 03: more than all sets of markers have
};

inline constexpr std::size_t kNoticeCodeCount = 17;

/// One oddity; several of a kind in one datagram are one notice with a count, so that notices stay few.
struct Notice {
    NoticeCode code = NoticeCode::UnknownType;
    std::uint32_t offset = 0; ///< of the first place, bytes from the datagram's first byte
    std::uint32_t count = 1;  ///< how many places (TrailingBytes, SizeDisagrees: how many bytes)

    friend bool operator==(const Notice&, const Notice&) = default;
};

std::string_view noticeName(NoticeCode code);
std::string noticeText(const Notice& notice, FaultLanguage language = inEnglish);

} // namespace posewire::wire
