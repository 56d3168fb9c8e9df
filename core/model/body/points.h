// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/body/segments.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace posewire::model {

/// An anatomical point fixed to a segment. The table follows the order of MVN's own point lists, from which
/// the local IDs are counted; positions are those of a 1.75 m reference body, averaged over two recordings.
struct AnatomicalPoint {
    int segment = 0;       ///< body segment index
    int localId = 0;       ///< 1-based within the segment
    std::string_view name; ///< "pSacrum"; joints begin with j
    std::array<double, 3> reference{};
};

inline constexpr int kPointCount = 127;
inline constexpr int kMarkerCount = 64;
inline constexpr int kMaxLocalPointId = 14;

/// All points, by segment and local ID.
std::span<const AnatomicalPoint> anatomicalPoints();

/// Places in anatomicalPoints() of the 64 points that optical-style marker sets use (type 03).
std::span<const int> markerPoints();

/// Null where the segment has no such point.
const AnatomicalPoint* findPoint(int segment, int localId);
const AnatomicalPoint* findPoint(std::string_view name);

/// How a point ID is put together: 256 · segment ID + point since revision J, 100 · segment ID + point in E
/// (and in one sentence of all revisions).
enum class PointIdCoding : std::uint8_t { By256, By100, Unknown };

struct PointReference {
    int segmentId = 0; ///< on the wire, 1-based
    int localId = 0;
    friend bool operator==(const PointReference&, const PointReference&) = default;
};

/// Meaningless for PointIdCoding::Unknown, which gives 0.
std::uint32_t encodePointId(PointIdCoding coding, PointReference reference);

/// Empty for PointIdCoding::Unknown.
std::optional<PointReference> decodePointId(PointIdCoding coding, std::uint32_t id);

/// The same, but empty also where the segment (1–67, 1–28 in By100) has no such point (at most 14 where it is
/// not of the body).
std::optional<PointReference> knownPoint(PointIdCoding coding, std::uint32_t id);

/// A single ID is ambiguous (513 is 2.1 or 5.13), a whole datagram is not: the coding in which more points
/// from the first on are known, 256 where both know as many. Tags follow the points, with numbers of their
/// own. Unknown where neither coding knows the first.
PointIdCoding detectPointIdCoding(std::span<const std::uint32_t> ids);

} // namespace posewire::model
