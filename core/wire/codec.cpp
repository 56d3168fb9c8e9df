// SPDX-License-Identifier: MIT
#include "core/wire/codec.h"

#include "core/wire/checks.h"
#include "core/wire/forms_of.h"
#include "core/wire/message_parts.h"
#include "core/wire/payload.h"
#include "core/wire/write.h"

namespace posewire::wire {
namespace {

struct Sizes {
    std::size_t operator()(const RawBody& raw) const { return raw.bytes.size(); }
    template <class T>
    std::size_t operator()(const T& value) const {
        return withForm<T>(formOf(value), [&]<Form F>() { return writtenSize<T, F>(value); });
    }
};

void writeBody(std::byte* to, const Body& body) {
    std::visit(
        [&]<class T>(const T& value) {
            if constexpr (std::is_same_v<T, RawBody>) {
                std::copy(value.bytes.begin(), value.bytes.end(), to);
            } else {
                withForm<T>(formOf(value), [&]<Form F>() { writeLayout<T, F>(to, value); });
            }
        },
        body);
}

/// Every length prefix fits, since the whole datagram does; what is left to check is that no list outgrows
/// its maximum and no zero-terminated string has a zero inside.
template <class T, Form F>
bool fitsItsCounts(const T& value) {
    bool fits = true;
    forEachField<T, F>([&]<class FieldType>(const FieldType&) {
        const auto& member = value.*FieldType::kMember;
        if constexpr (requires { FieldType::kItemForm; }) {
            using Item = typename MemberValue<FieldType::kMember>::value_type;
            std::size_t most = kMaxItems;
            if constexpr (requires { FieldType::kMax; }) {
                most = FieldType::kMax;
            }
            fits = fits && member.size() <= most;
            for (const Item& item : member) {
                fits = fits && fitsItsCounts<Item, FieldType::kItemForm>(item);
            }
        } else if constexpr (requires { FieldType::kKind; }) {
            const bool endsAtZero = FieldType::kKind == TextKind::ZeroTerminated;
            fits = fits && (!endsAtZero || member.find('\0') == std::string::npos);
        }
    });
    return fits;
}

bool fitsItsCounts(const Body& body) {
    return std::visit(
        []<class T>(const T& value) {
            if constexpr (std::is_same_v<T, RawBody>) {
                return true;
            } else {
                return withForm<T>(formOf(value), [&]<Form F>() { return fitsItsCounts<T, F>(value); });
            }
        },
        body);
}

} // namespace

Result<void> decodeInto(Bytes bytes, Datagram& into) {
    into.notices.clear();
    const auto header = decodeHeader(bytes);
    if (!header) {
        return tl::unexpected(header.error());
    }
    into.header = *header;
    SilentVisitor silent;
    Cursor cursor = payloadCursor(bytes, *header);
    if (!readBody(cursor, into, silent)) {
        return tl::unexpected(cursor.error);
    }
    checkValues(bytes, into);
    return {};
}

Result<Datagram> decode(Bytes bytes) {
    Datagram datagram;
    if (const auto result = decodeInto(bytes, datagram); !result) {
        return tl::unexpected(result.error());
    }
    return datagram;
}

Result<void> encodeInto(const Datagram& datagram, std::vector<std::byte>& into) {
    const std::size_t size = kHeaderSize + payloadSize(datagram.body);
    if (size > kMaxDatagramSize || !fitsItsCounts(datagram.body)) {
        return tl::unexpected(WireError{ErrorCode::TooLong, datagram.header.type(), 0, kMaxDatagramSize,
                                        static_cast<std::uint32_t>(size)});
    }
    into.resize(size);
    writeLayout<Header, Form::Standard>(into.data(), datagram.header);
    writeBody(into.data() + kHeaderSize, datagram.body);
    return {};
}

Result<std::vector<std::byte>> encode(const Datagram& datagram) {
    std::vector<std::byte> bytes;
    if (const auto result = encodeInto(datagram, bytes); !result) {
        return tl::unexpected(result.error());
    }
    return bytes;
}

void completeHeader(Datagram& datagram, HeaderEra era) {
    Header& header = datagram.header;
    std::visit(
        [&]<class T>(const T&) {
            if constexpr (!std::is_same_v<T, RawBody>) {
                header.setType(T::kType);
            }
        },
        datagram.body);
    header.items = static_cast<std::uint8_t>(announcedItems(datagram.body));
    if (era == HeaderEra::Counted) {
        header.payloadSize = static_cast<std::uint16_t>(payloadSize(datagram.body));
    } else {
        header.payloadSize = 0;
        header.bodySegments = header.props = header.fingerSegments = 0;
    }
}

std::size_t payloadSize(const Body& body) {
    return std::visit(Sizes{}, body);
}

} // namespace posewire::wire
