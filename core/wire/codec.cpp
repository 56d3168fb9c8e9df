// SPDX-License-Identifier: MIT
#include "core/wire/codec.h"

#include "core/wire/checks.h"
#include "core/wire/forms_of.h"
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

struct ItemCounts {
    std::size_t operator()(const MetaData&) const { return 1; }
    std::size_t operator()(const PropInformation& value) const { return value.props.size(); }
    std::size_t operator()(const PointPositions& value) const { return value.points.size(); }
    std::size_t operator()(const TagPositions& value) const { return value.points.size(); }
    std::size_t operator()(const JointAngles& value) const { return value.joints.size(); }
    std::size_t operator()(const TrackerKinematics& value) const { return value.trackers.size(); }
    std::size_t operator()(const CentreOfMass&) const { return 1; }
    std::size_t operator()(const TimeCode&) const { return 1; }
    std::size_t operator()(const NullPose&) const { return 0; }
    std::size_t operator()(const RawBody&) const { return 0; }
    std::size_t operator()(const auto& value) const { return value.segments.size(); }
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
bool fitsItsCounts(const Body& body) {
    if (const auto* pose = std::get_if<NullPose>(&body)) {
        return pose->segments.size() <= kMaxNullPoseSegments && pose->points.size() <= kMaxNullPosePoints;
    }
    if (const auto* message = std::get_if<PropInformation>(&body)) {
        for (const Prop& prop : message->props) {
            if (prop.name.find('\0') != std::string::npos) {
                return false;
            }
        }
    }
    return std::visit(ItemCounts{}, body) <= kMaxItems;
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
    header.items = static_cast<std::uint8_t>(std::visit(ItemCounts{}, datagram.body));
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
