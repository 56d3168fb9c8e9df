// SPDX-License-Identifier: MIT
#include "core/wire/header.h"

#include "core/wire/message_layouts.h"
#include "core/wire/walk.h"

namespace posewire::wire {
namespace {

bool isDigit(std::byte character) {
    return character >= std::byte{'0'} && character <= std::byte{'9'};
}

constexpr std::string_view kMagic = "MXTP";

} // namespace

bool startsWithMagic(Bytes bytes) {
    return bytes.size() >= kMagic.size() && std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) == 0;
}

bool startsDatagram(Bytes bytes) {
    return bytes.size() >= 6 && startsWithMagic(bytes) && isDigit(bytes[4]) && isDigit(bytes[5]);
}

Result<Header> decodeHeader(Bytes bytes) {
    const std::size_t magic = std::min(bytes.size(), kMagic.size());
    if (magic != 0 && std::memcmp(bytes.data(), kMagic.data(), magic) != 0) {
        return tl::unexpected(WireError{ErrorCode::BadMagic, 0, 0, 4, static_cast<std::uint32_t>(magic)});
    }
    if (bytes.size() >= 6 && !startsDatagram(bytes)) {
        return tl::unexpected(WireError{ErrorCode::BadType, 0, 4, 2, 2});
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

} // namespace posewire::wire
