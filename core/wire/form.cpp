// SPDX-License-Identifier: MIT
#include "core/wire/form.h"

#include "core/wire/byte_order.h"
#include "core/wire/text.h"

namespace posewire::wire {
namespace {

/// Tags of revision E are 16 bytes each; what newer programs send as type 04 is not documented.
Form tagsForm(const Header& header, Bytes payload) {
    const bool isDocumented = payload.size() == sizeWith<TagPositions, Form::Standard>(header.items);
    return isDocumented ? Form::Standard : Form::Raw;
}

/// True for a payload of the short form, or one with a stray byte behind it: less than one more field.
template <class T>
bool isShort(const Header& header, Bytes payload) {
    const std::size_t shortSize = sizeWith<T, Form::Short>(header.items);
    const std::size_t size = header.payloadSize != 0 ? header.payloadSize : payload.size();
    return shortSize != 0 && size >= shortSize && size - shortSize < sizeof(float);
}

bool isColon(Bytes payload, std::size_t place) {
    return place < payload.size() && payload[place] == std::byte{':'};
}

/// The length of a datagram's text begins with a zero byte, which no text does. A negative length is no
/// length: the bytes are a text where they can be one, such as "é:1".
Form bareForm(std::type_identity<MetaData>, Bytes payload) {
    if (payload.size() < 4 || payload[0] == std::byte{0}) {
        return payload.size() < 4 ? Form::Bare : Form::Standard;
    }
    const std::string_view text(reinterpret_cast<const char*>(payload.data()), payload.size());
    const bool isNegative = (payload[0] & std::byte{0x80}) != std::byte{0};
    return isNegative && firstInvalidUtf8(text) != text.size() ? Form::Standard : Form::Bare;
}

Form bareForm(std::type_identity<TimeCode>, Bytes payload) {
    if (payload.size() >= 16 && load32(payload.data()) == 12) {
        return Form::Standard;
    }
    if (isColon(payload, 2) && isColon(payload, 5)) {
        return Form::Bare;
    }
    const bool isPrefixed = payload.size() >= 16 || (isColon(payload, 6) && isColon(payload, 9)) ||
                            (payload.size() >= 4 && load32(payload.data()) == 12);
    return isPrefixed ? Form::Standard : Form::Bare;
}

template <class T>
Form formOfMessage(const Header& header, Bytes payload) {
    if constexpr (std::is_same_v<T, TagPositions>) {
        return tagsForm(header, payload);
    } else if constexpr (kHasForm<T, Form::Bare>) {
        return bareForm(std::type_identity<T>{}, payload);
    } else if constexpr (kHasForm<T, Form::Short>) {
        return isShort<T>(header, payload) ? Form::Short : Form::Standard;
    } else {
        return Form::Standard;
    }
}

} // namespace

std::size_t sentPayload(const Header& header, Bytes payload) {
    if (header.payloadSize == 0) {
        return payload.size();
    }
    const bool isTimeCode = header.type() == TimeCode::kType;
    const bool leavesLengthOut = isTimeCode && header.payloadSize == kWireSize<TimeCode, Form::Bare> &&
                                 isColon(payload, 6) && isColon(payload, 9);
    return leavesLengthOut ? kWireSize<TimeCode> : header.payloadSize;
}

Form formOf(const Header& header, Bytes payload) {
    Form form = Form::Standard;
    Messages::with(header.type(), [&]<class T>() { form = formOfMessage<T>(header, payload); });
    return form;
}

} // namespace posewire::wire
