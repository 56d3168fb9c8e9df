// SPDX-License-Identifier: MIT
#include "core/wire/header.h"

#include "core/wire/form.h"
#include "core/wire/walk.h"

#include <initializer_list>

namespace posewire::wire {
namespace {

constexpr std::string_view kMagic = "MXTP";
constexpr std::size_t kMark = kMagic.size() + 2; ///< bytes that every datagram begins with

bool isDigit(std::byte character) {
    return character >= std::byte{'0'} && character <= std::byte{'9'};
}

/// A digit of a type, or the number that some send in its place.
bool isOfType(std::byte character) {
    return isDigit(character) || character < std::byte{10};
}

/// "MXTP" and a type, or what there is of it.
bool mayStartDatagram(Bytes bytes) {
    for (std::size_t i = 0; i < std::min(bytes.size(), kMark); ++i) {
        const bool isMagic = i < kMagic.size();
        if (isMagic ? static_cast<char>(bytes[i]) != kMagic[i] : !isOfType(bytes[i])) {
            return false;
        }
    }
    return true;
}

constexpr Extent known(std::size_t size) {
    return size <= kMaxDatagramSize ? Extent{Extent::State::Known, size} : Extent{Extent::State::Unknown, 0};
}
constexpr Extent kNeedMore{Extent::State::NeedMore, 0};
constexpr Extent kUnknown{Extent::State::Unknown, 0};

/// The first of the sizes that is followed by another datagram or the end of the stream.
Extent firstThatFits(Bytes bytes, bool isAtEnd, std::initializer_list<std::size_t> sizes) {
    for (const std::size_t size : sizes) {
        if (bytes.size() < size) {
            return isAtEnd ? known(*sizes.begin()) : kNeedMore;
        }
        const Bytes next = bytes.subspan(size);
        if (next.size() < kMark && !isAtEnd && mayStartDatagram(next)) {
            return kNeedMore;
        }
        if (mayStartDatagram(next)) {
            return known(size);
        }
    }
    return kUnknown;
}

/// The longest list that a message may have with a count of its own.
template <class T>
constexpr std::size_t longestList() {
    std::size_t most = 0;
    forEachList<T, Form::Standard>([&]<class List>(const List&) { most = std::max(most, List::kMax); });
    return most;
}

/// Walks a payload whose size only its content gives; a fault for want of bytes means that more must come.
template <class T>
Extent walked(Bytes bytes, const Header& header, bool isAtEnd) {
    T value;
    SilentVisitor silent;
    Cursor cursor{bytes, kHeaderSize, header.items, {}};
    if (readLayout<T, Form::Standard>(cursor, value, silent)) {
        return known(cursor.offset);
    }
    const bool isHopeless =
        cursor.error.code == ErrorCode::BadSequence ||
        (cursor.error.code == ErrorCode::CountTooLarge && cursor.error.need > longestList<T>());
    if (isHopeless || isAtEnd || bytes.size() >= kMaxDatagramSize) {
        return kUnknown;
    }
    return kNeedMore;
}

/// A text that may lack the length before it; without it nothing says where it ends.
Extent textExtent(Bytes bytes, bool isAtEnd) {
    if (bytes.size() < kHeaderSize + 4) {
        return isAtEnd ? kUnknown : kNeedMore;
    }
    const auto length = static_cast<std::int32_t>(load32(bytes.data() + kHeaderSize));
    const bool isPrefixed = length >= 0 && length <= static_cast<std::int32_t>(kMaxDatagramSize);
    return isPrefixed ? known(kHeaderSize + 4 + static_cast<std::size_t>(length)) : kUnknown;
}

template <class T>
Extent extentOf(Bytes bytes, const Header& header, bool isAtEnd) {
    if constexpr (!kIsSized<T>) {
        return kHasForm<T, Form::Bare> ? textExtent(bytes, isAtEnd) : walked<T>(bytes, header, isAtEnd);
    } else if constexpr (kOtherForm<T> != Form::Standard) {
        return firstThatFits(bytes, isAtEnd,
                             {kHeaderSize + sizeWith<T, kOtherForm<T>>(header.items),
                              kHeaderSize + sizeWith<T, Form::Standard>(header.items)});
    } else {
        return known(kHeaderSize + sizeWith<T, Form::Standard>(header.items));
    }
}

} // namespace

bool startsWithMagic(Bytes bytes) {
    return bytes.size() >= kMagic.size() && std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) == 0;
}

bool startsDatagram(Bytes bytes) {
    return bytes.size() >= kMark && startsWithMagic(bytes) && isOfType(bytes[4]) && isOfType(bytes[5]);
}

Result<Header> decodeHeader(Bytes bytes) {
    if (!startsDatagram(bytes)) {
        const std::size_t magic = std::min(bytes.size(), kMagic.size());
        if (!mayStartDatagram(bytes.first(magic))) {
            return tl::unexpected(WireError{ErrorCode::BadMagic, 0, 0, 4, static_cast<std::uint32_t>(magic)});
        }
        if (bytes.size() >= kMark) {
            return tl::unexpected(WireError{ErrorCode::BadType, 0, 4, 2, 2});
        }
    }
    if (bytes.size() >= kMark && !(isDigit(bytes[4]) && isDigit(bytes[5]))) {
        const auto digit = [&](std::size_t place) {
            return std::to_integer<std::uint32_t>(bytes[place]) & 15U;
        };
        return tl::unexpected(WireError{ErrorCode::TypeAsNumber, 0, 4, digit(4), digit(5)});
    }
    if (bytes.size() < kHeaderSize) {
        const auto have = static_cast<std::uint32_t>(bytes.size());
        return tl::unexpected(WireError{ErrorCode::HeaderTruncated, 0, have, kHeaderSize, have});
    }
    Header header;
    Cursor cursor{bytes, 0, 0, {}};
    SilentVisitor silent;
    detail::readFixed<Header, Form::Standard>(cursor, header, silent);
    return header;
}

Extent datagramExtent(Bytes bytes, bool isAtEnd) {
    if (!mayStartDatagram(bytes)) {
        return {Extent::State::Foreign, 0};
    }
    const auto header = decodeHeader(bytes);
    if (!header) {
        const bool isWhole = header.error().code == ErrorCode::TypeAsNumber && bytes.size() >= kHeaderSize;
        return isAtEnd || isWhole ? kUnknown : kNeedMore;
    }
    if (header->payloadSize != 0) {
        const Bytes payload = bytes.subspan(kHeaderSize);
        const bool isBareTimeCode =
            header->type() == TimeCode::kType && header->payloadSize == kWireSize<TimeCode, Form::Bare>;
        if (isBareTimeCode && payload.size() < header->payloadSize && !isAtEnd) {
            return kNeedMore; // the first bytes show whether the sender left the length out of its count
        }
        return known(kHeaderSize + sentPayload(*header, payload));
    }
    Extent extent = kUnknown;
    Messages::with(header->type(), [&]<class T>() { extent = extentOf<T>(bytes, *header, isAtEnd); });
    return extent;
}

std::size_t firstDatagram(Bytes packet) {
    if (packet.size() < 2 * kHeaderSize || !startsWithMagic(packet)) {
        return packet.size();
    }
    const Extent extent = datagramExtent(packet, true);
    const bool isClosed = extent.state == Extent::State::Known && extent.size + kHeaderSize <= packet.size();
    return isClosed && startsDatagram(packet.subspan(extent.size)) ? extent.size : packet.size();
}

std::size_t countDatagrams(Bytes packet) {
    std::size_t count = 0;
    for (; !packet.empty(); ++count) {
        packet = packet.subspan(firstDatagram(packet));
    }
    return count;
}

} // namespace posewire::wire
