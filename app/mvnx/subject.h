// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/mvnx/xml_reader.h"

#include "core/wire/messages.h"

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace posewire::mvnx {

/// All that a file says of one performer before its frames.
struct Subject {
    struct Segment {
        std::uint32_t id = 0; ///< on the wire, 1-based
        std::string name;
    };
    /// IDs as type 20 has them: 256 · segment + point, point 0 for the segment itself.
    struct Joint {
        std::uint32_t parent = 0;
        std::uint32_t child = 0;
    };
    static constexpr std::size_t kMostSegments = 67; ///< of joints and sensors as well
    static constexpr std::size_t kMostPoints = 1024; ///< MVN's files have 127
    static constexpr double kMostHz = 1000;

    std::string name;
    std::string colour; ///< "#00ff00"; may be empty
    double rateHz = 60; ///< above 0
    /// When it was recorded, in ms since 1970; empty if the file does not say.
    std::optional<std::int64_t> begin{};
    std::vector<Segment> segments;           ///< body, then props
    std::vector<wire::NullPosePoint> points; ///< in metres from their segment's origin
    std::vector<std::uint32_t> sensors;      ///< segments that carry one
    std::vector<Joint> joints;               ///< of jointAngle
    std::vector<Joint> ergonomicAngles;      ///< of jointAngleErgo

    /// Takes the element that has just begun or ended, of those within <subject>. Fails if it makes no sense.
    tl::expected<void, log::FileError> begins(const XmlReader& xml);
    tl::expected<void, log::FileError> ends(const XmlReader& xml);

private:
    [[nodiscard]] std::uint32_t idOf(std::string_view segment) const; ///< 0 if there is none
    /// Of "RightUpperLeg/jRightKnee".
    [[nodiscard]] std::uint32_t pointIdOf(std::string_view connector) const;
};

/// The number that a text is, all of it.
template <typename Number>
std::optional<Number> numberIn(std::string_view text) {
    Number number{};
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool isWhole = parsed.ec == std::errc() && parsed.ptr == text.data() + text.size();
    return isWhole ? std::optional(number) : std::nullopt;
}

/// The numbers of a text, divided by spaces. Fails if one of them is none, or there are more than `most`.
tl::expected<void, log::FileError> readNumbers(const XmlReader& xml, std::size_t most,
                                               std::vector<float>& into);

} // namespace posewire::mvnx
