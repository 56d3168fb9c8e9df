// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/mvnx/subject.h"

#include "core/wire/codec.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace posewire::mvnx {

/// Takes one datagram, valid during the call.
using TakeDatagram = std::function<void(std::span<const std::byte>)>;

/// One frame of a subject: what its elements hold, and the messages that MVN sends of that.
class Frame {
public:
    enum Field : std::uint8_t {
        Orientation,
        Position,
        Velocity,
        Acceleration,
        AngularVelocity,
        AngularAcceleration,
        SensorFreeAcceleration,
        SensorAcceleration,
        SensorAngularVelocity,
        SensorMagneticField,
        SensorOrientation,
        JointAngle,
        JointAngleErgo,
        CentreOfMass,
        FieldCount,
    };

    std::uint32_t index = 0; ///< the sample counter
    /// Of the header: ms since the take began.
    std::uint32_t timeMs = 0;
    std::optional<std::int64_t> epochMs; ///< since 1970

    /// Takes <frame ...>: what was there is gone. Of a frame without an index it is the next one.
    tl::expected<void, log::FileError> begins(const XmlReader& xml, double rateHz);
    /// Takes an element of the frame; skips those that no message has. Fails if the number of its numbers is
    /// not that of the subject's segments, sensors or joints.
    tl::expected<void, log::FileError> ends(const XmlReader& xml, const Subject& subject);

    /// A pose that was not performed: "tpose"; see isNullPose().
    [[nodiscard]] bool isNormal() const { return m_type == "normal" || m_type.empty(); }
    /// The segments' origins in it are those of type 13: `identity`, `npose` in files of version 3, or any
    /// other pose with no segment turned.
    [[nodiscard]] bool isNullPose() const;

    /// Types 25, 02, 20, 21, 22, 23 and 24, as far as the frame has what they hold. `timeCode` is that of
    /// the file, HH:MM:SS:frame.
    void send(const Subject& subject, std::uint8_t character, const TakeDatagram& take);
    /// Types 12 and 13; `nullPose` has the origin of each segment or is empty.
    void sendDescription(const Subject& subject, std::uint8_t character, std::span<const float> nullPose,
                         const TakeDatagram& take);

    [[nodiscard]] std::span<const float> field(Field which) const { return m_fields[which]; }

private:
    [[nodiscard]] bool has(std::initializer_list<Field> fields) const;
    template <std::size_t Size>
    [[nodiscard]] std::array<float, Size> at(Field which, std::size_t item) const;
    void put(const Subject& subject, std::uint8_t character, const TakeDatagram& take);
    [[nodiscard]] wire::TrackerKinematics trackers(const Subject& subject) const;
    [[nodiscard]] wire::JointAngles jointAngles(const Subject& subject) const;
    [[nodiscard]] std::optional<wire::TimeCode> timeCode(double rateHz) const;

    std::string m_type;
    std::string m_timeCode;
    bool m_hasBegun = false;
    std::array<std::vector<float>, FieldCount> m_fields;
    wire::Datagram m_datagram;
    std::vector<std::byte> m_bytes;
};

} // namespace posewire::mvnx
