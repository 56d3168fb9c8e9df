// SPDX-License-Identifier: MIT
#include "core/wire/codec.h"

#include "core/wire/payload.h"
#include "core/wire/write.h"

#include <optional>

namespace posewire::wire {
namespace {

/// What a list has and may have that outgrows its maximum; zeros of a zero-terminated string with a zero
/// inside. Every length prefix fits, since the whole datagram does.
struct Misfit {
    ErrorCode code = ErrorCode::TooLong;
    std::size_t need = 0;
    std::size_t have = 0;
};

template <class T, Form F>
std::optional<Misfit> misfitIn(const T& value) {
    std::optional<Misfit> misfit;
    forEachField<T, F>([&]<class FieldType>(const FieldType&) {
        if (misfit) {
            return;
        }
        const auto& member = value.*FieldType::kMember;
        if constexpr (requires { FieldType::kItemForm; }) {
            constexpr std::size_t most = FieldType::kIsCounted ? FieldType::kMax : kMaxItems;
            if (member.size() > most) {
                misfit = Misfit{ErrorCode::CountTooLarge, member.size(), most};
            }
            for (auto item = member.begin(); !misfit && item != member.end(); ++item) {
                misfit = misfitIn<typename FieldType::Item, FieldType::kItemForm>(*item);
            }
        } else if constexpr (requires { FieldType::kKind; }) {
            if (FieldType::kKind == TextKind::ZeroTerminated && member.find('\0') != std::string::npos) {
                misfit = Misfit{};
            }
        }
    });
    return misfit;
}

/// Calls f(list, list's kind) for each list of a body; const or not as the body is. Lists are the same in all
/// forms of a message.
template <class BodyType, class Function>
void forEachListOf(BodyType& body, Function&& f) {
    std::visit(
        [&]<class Value>(Value& value) {
            using T = std::remove_const_t<Value>;
            if constexpr (!std::is_same_v<T, RawBody>) {
                forEachList<T, Form::Standard>(
                    [&]<class List>(const List&) { f(value.*List::kMember, List::kIsCounted); });
            }
        },
        body);
}

/// What a header says as "number of items" (§2.4.1.4): of a list its items, 1 for a message without a list, 0
/// where lists have counts of their own, and for raw bytes.
std::size_t announcedItems(const Body& body) {
    bool hasList = std::holds_alternative<RawBody>(body);
    forEachListOf(body, [&](const auto&, bool) { hasList = true; });
    return hasList ? dividableItems(body) : 1;
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
    return decodeInto(bytes, datagram).map([&] { return std::move(datagram); });
}

Result<void> encodeInto(const Datagram& datagram, std::vector<std::byte>& into) {
    const std::size_t size = kHeaderSize + payloadSize(datagram.body);
    std::optional<Misfit> misfit;
    visitMessage(datagram.body, [&]<Form F, class T>(const T& message) { misfit = misfitIn<T, F>(message); });
    if (!misfit && size > kMaxDatagramSize) {
        misfit = Misfit{ErrorCode::TooLong, size, kMaxDatagramSize};
    }
    if (misfit) {
        return tl::unexpected(WireError{misfit->code, datagram.header.type(), 0,
                                        static_cast<std::uint32_t>(misfit->need),
                                        static_cast<std::uint32_t>(misfit->have)});
    }
    into.resize(size);
    const auto payload = putLayout<Header, Form::Standard>(ByteWriter{into.data()}, datagram.header);
    if (const auto* raw = std::get_if<RawBody>(&datagram.body)) {
        std::copy(raw->bytes.begin(), raw->bytes.end(), payload.to);
    }
    visitMessage(datagram.body,
                 [&]<Form F, class T>(const T& message) { putLayout<T, F>(payload, message); });
    return {};
}

Result<std::vector<std::byte>> encode(const Datagram& datagram) {
    std::vector<std::byte> bytes;
    return encodeInto(datagram, bytes).map([&] { return std::move(bytes); });
}

void completeHeader(Datagram& datagram, HeaderEra era) {
    Header& header = datagram.header;
    visitMessage(datagram.body, [&]<Form F, class T>(const T&) { header.setType(T::kType); });
    header.items = static_cast<std::uint8_t>(announcedItems(datagram.body));
    if (era == HeaderEra::Counted) {
        header.payloadSize = static_cast<std::uint16_t>(payloadSize(datagram.body));
    } else {
        header.payloadSize = 0;
        header.bodySegments = header.props = header.fingerSegments = 0;
    }
}

std::size_t payloadSize(const Body& body) {
    const auto* raw = std::get_if<RawBody>(&body);
    std::size_t size = raw != nullptr ? raw->bytes.size() : 0;
    visitMessage(body, [&]<Form F, class T>(const T& message) { size = writtenSize<T, F>(message); });
    return size;
}

std::size_t dividableItems(const Body& body) {
    std::size_t items = 0;
    forEachListOf(body, [&](const auto& list, bool isCounted) { items += isCounted ? 0 : list.size(); });
    return items;
}

void keepItems(Body& body, std::size_t from, std::size_t to) {
    forEachListOf(body, [&](auto& list, bool isCounted) {
        if (!isCounted) {
            list.erase(list.begin() + static_cast<std::ptrdiff_t>(to), list.end());
            list.erase(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(from));
        }
    });
}

void appendPart(Datagram& whole, const Datagram& part) {
    std::visit(
        [&]<class T>(T& value) {
            const T* next = std::get_if<T>(&part.body);
            if constexpr (!std::is_same_v<T, RawBody>) {
                forEachList<T, Form::Standard>([&]<class List>(const List&) {
                    if (next != nullptr) {
                        const auto& items = next->*List::kMember;
                        auto& list = value.*List::kMember;
                        list.insert(list.end(), items.begin(), items.end());
                    }
                });
            }
        },
        whole.body);
    whole.notices.insert(whole.notices.end(), part.notices.begin(), part.notices.end());
}

} // namespace posewire::wire
