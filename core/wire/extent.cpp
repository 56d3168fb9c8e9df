// SPDX-License-Identifier: MIT
#include "core/wire/extent.h"

#include "core/wire/form.h"
#include "core/wire/walk.h"

#include <initializer_list>

namespace posewire::wire {
namespace {

constexpr Extent known(std::size_t size) {
    return size <= kMaxDatagramSize ? Extent{Extent::State::Known, size} : Extent{Extent::State::Unknown, 0};
}
constexpr Extent kNeedMore{Extent::State::NeedMore, 0};
constexpr Extent kUnknown{Extent::State::Unknown, 0};

/// "MXTP" and two digits, or what there is of it.
bool mayStartDatagram(Bytes bytes) {
    constexpr std::string_view magic = "MXTP";
    for (std::size_t i = 0; i < std::min<std::size_t>(bytes.size(), 6); ++i) {
        const char character = static_cast<char>(bytes[i]);
        if (i < 4 ? character != magic[i] : (character < '0' || character > '9')) {
            return false;
        }
    }
    return true;
}

/// The first of the sizes that is followed by another datagram or the end of the stream.
Extent firstThatFits(Bytes bytes, bool isAtEnd, std::initializer_list<std::size_t> sizes) {
    for (const std::size_t size : sizes) {
        if (bytes.size() < size) {
            return isAtEnd ? known(*sizes.begin()) : kNeedMore;
        }
        const Bytes next = bytes.subspan(size);
        if (next.size() < 6 && !isAtEnd && mayStartDatagram(next)) {
            return kNeedMore;
        }
        if (mayStartDatagram(next)) {
            return known(size);
        }
    }
    return kUnknown;
}

/// Walks a payload whose size only its content tells; a fault for want of bytes means that more must come.
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
        (cursor.error.code == ErrorCode::CountTooLarge && cursor.error.need > kMaxNullPosePoints);
    if (isHopeless || isAtEnd || bytes.size() >= kMaxDatagramSize) {
        return kUnknown;
    }
    return kNeedMore;
}

Extent metaDataExtent(Bytes bytes, bool isAtEnd) {
    if (bytes.size() < kHeaderSize + 4) {
        return isAtEnd ? kUnknown : kNeedMore;
    }
    const auto length = static_cast<std::int32_t>(load32(bytes.data() + kHeaderSize));
    const bool isPrefixed = length >= 0 && length <= static_cast<std::int32_t>(kMaxDatagramSize);
    return isPrefixed ? known(kHeaderSize + 4 + static_cast<std::size_t>(length)) : kUnknown;
}

template <class Item>
Extent ofItems(const Header& header) {
    return known(kHeaderSize + header.items * kWireSize<Item>);
}

Extent computed(Bytes bytes, const Header& header, bool isAtEnd) {
    switch (header.type()) {
    case PoseEuler::kType:
        return ofItems<SegmentEuler>(header);
    case PoseQuaternion::kType:
    case PoseUnity::kType:
        return ofItems<SegmentQuaternion>(header);
    case PointPositions::kType:
    case TagPositions::kType:
        return ofItems<Point>(header);
    case ScaleInformation::kType:
        return ofItems<SegmentScale>(header);
    case PropInformation::kType:
        return walked<PropInformation>(bytes, header, isAtEnd);
    case MetaData::kType:
        return metaDataExtent(bytes, isAtEnd);
    case NullPose::kType:
        return walked<NullPose>(bytes, header, isAtEnd);
    case JointAngles::kType:
        return ofItems<Joint>(header);
    case LinearKinematics::kType:
        return ofItems<LinearSegment>(header);
    case AngularKinematics::kType:
        return ofItems<AngularSegment>(header);
    case TrackerKinematics::kType:
        return firstThatFits(bytes, isAtEnd,
                             {kHeaderSize + header.items * kWireSize<Tracker, Form::Short>,
                              kHeaderSize + header.items * kWireSize<Tracker>});
    case CentreOfMass::kType:
        return firstThatFits(
            bytes, isAtEnd,
            {kHeaderSize + kWireSize<CentreOfMass, Form::Short>, kHeaderSize + kWireSize<CentreOfMass>});
    case TimeCode::kType:
        return firstThatFits(
            bytes, isAtEnd,
            {kHeaderSize + kWireSize<TimeCode, Form::Bare>, kHeaderSize + kWireSize<TimeCode>});
    default:
        return kUnknown;
    }
}

} // namespace

Extent datagramExtent(Bytes bytes, bool isAtEnd) {
    if (!mayStartDatagram(bytes)) {
        return {Extent::State::Foreign, 0};
    }
    const auto header = decodeHeader(bytes);
    if (!header) {
        return isAtEnd ? kUnknown : kNeedMore;
    }
    if (header->payloadSize != 0) {
        const Bytes payload = bytes.subspan(kHeaderSize);
        const bool isBareTimeCode =
            header->type() == TimeCode::kType && header->payloadSize == kWireSize<TimeCode, Form::Bare>;
        if (isBareTimeCode && payload.size() < header->payloadSize && !isAtEnd) {
            return kNeedMore; // the first bytes tell whether the sender left the length out of its count
        }
        return known(kHeaderSize + sentPayload(*header, payload));
    }
    return computed(bytes, *header, isAtEnd);
}

} // namespace posewire::wire
