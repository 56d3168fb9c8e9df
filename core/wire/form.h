// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/header.h"
#include "core/wire/messages.h"

namespace posewire::wire {

/// Which of its layouts the payload of a datagram is in. The specification and real senders differ for types
/// 04, 12, 23, 24 and 25; sizes and the first bytes decide. `payload` ends where the datagram (or, if that is
/// shorter, the announced payload) ends. Never fails: what fits no form is reported when it is read.
[[nodiscard]] Form formOf(const Header& header, Bytes payload);

/// Bytes of `payload` that belong to the datagram by its header: all where the payload size is left out. At
/// least one sender counts 12 bytes of a time code and sends the four bytes of its length before them too.
[[nodiscard]] std::size_t sentPayload(const Header& header, Bytes payload);

/// The form that a value will be written in.
template <class T>
[[nodiscard]] Form formOf(const T&) {
    return Form::Standard;
}
[[nodiscard]] inline Form formOf(const MetaData& value) {
    return value.hasLengthPrefix ? Form::Standard : Form::Bare;
}
[[nodiscard]] inline Form formOf(const TimeCode& value) {
    return value.hasLengthPrefix ? Form::Standard : Form::Bare;
}
[[nodiscard]] inline Form formOf(const TrackerKinematics& value) {
    return value.hasInertialData ? Form::Standard : Form::Short;
}
[[nodiscard]] inline Form formOf(const CentreOfMass& value) {
    return value.hasDerivatives ? Form::Standard : Form::Short;
}

} // namespace posewire::wire
