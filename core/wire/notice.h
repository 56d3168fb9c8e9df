// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace posewire::wire {

/// What is odd about a datagram that could be read all the same. The texts are in notice.cpp, in this order.
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
};

inline constexpr std::size_t kNoticeCodeCount = 13;

/// One oddity; several of a kind in one datagram are one notice with a count, so that notices stay few.
struct Notice {
    NoticeCode code = NoticeCode::UnknownType;
    std::uint32_t offset = 0; ///< of the first place, bytes from the datagram's first byte
    std::uint32_t count = 1;  ///< how many places (TrailingBytes, SizeDisagrees: how many bytes)

    friend bool operator==(const Notice&, const Notice&) = default;
};

std::string_view noticeName(NoticeCode code);
std::string noticeText(const Notice& notice);

} // namespace posewire::wire
