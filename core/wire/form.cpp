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

Form trackersForm(const Header& header, Bytes payload) {
    const std::size_t size = header.payloadSize != 0 ? header.payloadSize : payload.size();
    return size == header.items * kWireSize<Tracker, Form::Short> ? Form::Short : Form::Standard;
}

Form centreOfMassForm(const Header& header, Bytes payload) {
    const std::size_t size = header.payloadSize != 0 ? header.payloadSize : payload.size();
    return size == kWireSize<CentreOfMass, Form::Short> ? Form::Short : Form::Standard;
}

Form timeCodeForm(Bytes payload) {
    const auto isColon = [&](std::size_t i) { return i < payload.size() && payload[i] == std::byte{':'}; };
    if (payload.size() >= 16 && load32(payload.data()) == 12) {
        return Form::Standard;
    }
    if (isColon(2) && isColon(5)) {
        return Form::Bare;
    }
    const bool isPrefixed = payload.size() >= 16 || (payload.size() >= 4 && load32(payload.data()) == 12);
    return isPrefixed ? Form::Standard : Form::Bare;
}

} // namespace

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
