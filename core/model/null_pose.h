// SPDX-License-Identifier: MIT
#pragma once

#include "core/wire/messages.h"

#include <Eigen/Core>

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace posewire::model {

/// A scale message put together from its datagrams (type 13): the null pose, a T-pose with all orientations
/// identity.
struct NullPose {
    struct Segment {
        std::string name;
        Eigen::Vector3d position; ///< metres, Z-up, world
    };
    struct Point {
        int segment = 0; ///< wire ID, 1-based
        int id = 0;      ///< within the segment
        std::string name;
        std::uint32_t flags = 0;
        Eigen::Vector3d position; ///< metres, from the segment's origin
    };
    std::vector<Segment> segments;
    std::vector<Point> points;
    unsigned partsReceived = 0;
    unsigned partsExpected = 0; ///< 0 as long as the last part has not arrived
    std::int64_t stampNs = 0;   ///< of the newest part
    std::uint64_t packet = 0;   ///< number of the newest part

    [[nodiscard]] bool isComplete() const { return partsExpected != 0 && partsReceived == partsExpected; }
};

/// Puts parts together. A message begins with datagram 0; parts may come in any order and more than once; a
/// part without segments adds to what is there.
class NullPoseAssembler {
public:
    /// Takes a part with its place from the header's datagram counter.
    void add(const wire::NullPose& part, std::uint8_t datagramCounter, std::uint64_t packet,
             std::int64_t stampNs);

    /// The newest message that has segments: complete, or, before there is a complete one, what has arrived
    /// of the first.
    [[nodiscard]] const NullPose* newest() const;

    /// The message that is arriving; differs from newest() until it is complete.
    [[nodiscard]] const NullPose& arriving() const { return m_arriving; }

private:
    void settle();
    [[nodiscard]] bool hasMoved() const;

    NullPose m_arriving;
    NullPose m_settled;
    std::vector<wire::NullPose> m_parts;
    std::vector<bool> m_present;
};

/// The scale messages of one character over time, as far as they differ. Bounded: the oldest go first.
class NullPoseHistory {
public:
    static constexpr std::size_t kMost = 64;

    void add(const wire::NullPose& part, std::uint8_t datagramCounter, std::uint64_t packet,
             std::int64_t stampNs);

    /// As of a packet number; null where there was none by then. What is older than the history counts as its
    /// oldest.
    [[nodiscard]] const NullPose* at(std::uint64_t packet) const;

    /// The message whose parts are arriving.
    [[nodiscard]] const NullPose& arriving() const { return m_assembler.arriving(); }

private:
    struct Version {
        std::uint64_t firstPacket;
        NullPose pose;
    };
    NullPoseAssembler m_assembler;
    std::deque<Version> m_versions;
};

} // namespace posewire::model
