// SPDX-License-Identifier: MIT
#include "core/wire/form.h"

#include "core/wire/byte_order.h"

namespace posewire::wire {
namespace {

/// Tags of revision E are 16 bytes each; what newer programs send as type 04 is not documented.
Form tagsForm(const Header& header, Bytes payload) {
    return payload.size() == header.items * kWireSize<Point> ? Form::Standard : Form::Raw;
}

/// A text never begins with a zero byte or as a negative length; a length of a datagram's text always does.
Form metaDataForm(Bytes payload) {
    const bool isPrefixed =
        payload.size() >= 4 && (payload[0] == std::byte{0} || (payload[0] & std::byte{0x80}) != std::byte{0});
    return isPrefixed ? Form::Standard : Form::Bare;
}

/// True for a payload of the short form, or one with a stray byte behind it: less than one more field.
bool isShort(const Header& header, Bytes payload, std::size_t shortSize) {
    const std::size_t size = header.payloadSize != 0 ? header.payloadSize : payload.size();
    return size >= shortSize && size - shortSize < sizeof(float);
}

Form trackersForm(const Header& header, Bytes payload) {
    const std::size_t shortSize = header.items * kWireSize<Tracker, Form::Short>;
    return header.items != 0 && isShort(header, payload, shortSize) ? Form::Short : Form::Standard;
}

Form centreOfMassForm(const Header& header, Bytes payload) {
    constexpr std::size_t shortSize = kWireSize<CentreOfMass, Form::Short>;
    return isShort(header, payload, shortSize) ? Form::Short : Form::Standard;
}

bool isColon(Bytes payload, std::size_t place) {
    return place < payload.size() && payload[place] == std::byte{':'};
}

Form timeCodeForm(Bytes payload) {
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
    switch (header.type()) {
    case TagPositions::kType:
        return tagsForm(header, payload);
    case MetaData::kType:
        return metaDataForm(payload);
    case TrackerKinematics::kType:
        return trackersForm(header, payload);
    case CentreOfMass::kType:
        return centreOfMassForm(header, payload);
    case TimeCode::kType:
        return timeCodeForm(payload);
    default:
        return Form::Standard;
    }
}

} // namespace posewire::wire
