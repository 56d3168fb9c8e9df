// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/wire/messages.h"

#include <Eigen/Core>

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace posewire::model {

/// How a scale message came, whether it differs from the one before or not.
struct NullPoseMessage {
    std::uint64_t firstPacket = 0; ///< number of the part that came first
    log::Stamp firstStamp{};       ///< its stamp
    log::Stamp stamp{};            ///< of the newest part
    unsigned partsReceived = 0;
    unsigned partsExpected = 0;         ///< 0 as long as the last part has not arrived
    std::vector<unsigned> missingParts; ///< places from 0, below the last one that is known of

    [[nodiscard]] bool isComplete() const { return partsExpected != 0 && partsReceived == partsExpected; }
};

/// A scale message put together from its datagrams (type 13): the null pose, a T-pose with all orientations
/// identity.
struct NullPose : NullPoseMessage {
    struct Segment {
        std::string name;
        Eigen::Vector3d position; ///< metres, Z-up, world
        friend bool operator==(const Segment&, const Segment&) = default;
    };
    struct Point {
        int segment = 0; ///< wire ID, 1-based
        int id = 0;      ///< within the segment
        std::string name;
        std::uint32_t flags = 0;
        Eigen::Vector3d position; ///< metres, from the segment's origin
        friend bool operator==(const Point&, const Point&) = default;
    };
    std::vector<Segment> segments;
    std::vector<Point> points;
    std::uint64_t message = 0; ///< counts the messages of its sender, from 1
    std::uint64_t packet = 0;  ///< number of the newest part
};

/// Puts parts together. Datagram 0 begins a message, unless others of the same message have overtaken it;
/// parts may come in any order and more than once; a part without segments adds to what is there.
class NullPoseAssembler {
public:
    /// Parts that come before datagram 0 are of its message if they come within this time of it.
    static constexpr log::Duration kTogether = std::chrono::milliseconds(250);
    /// A part that is repeated within this time is the network's doing and no new message.
    static constexpr log::Duration kDuplicate = std::chrono::milliseconds(100);

    /// Takes a part with its place from the header's datagram counter.
    void add(const wire::NullPose& part, std::uint8_t datagramCounter, std::uint64_t packet,
             log::Stamp stamp);

    /// The newest message that has segments: complete, or, before there is a complete one, what has arrived
    /// of the first.
    [[nodiscard]] const NullPose* newest() const;

    /// The message that is arriving; differs from newest() until it is complete.
    [[nodiscard]] const NullPose& arriving() const { return m_arriving; }

private:
    void begin(std::uint64_t packet, log::Stamp stamp);
    [[nodiscard]] bool isOvertaken(log::Stamp stamp) const;
    void settle();

    NullPose m_arriving;
    NullPose m_settled;
    std::vector<std::optional<wire::NullPose>> m_parts; ///< by place
};

/// What was known of a character's null pose at one moment. Valid until the history grows.
struct NullPoseRecord {
    const NullPose* pose = nullptr;          ///< null where there was none by then
    const NullPose* before = nullptr;        ///< the newest that differs, null where none does
    log::Stamp changed{};                    ///< when `pose` came first
    const NullPoseMessage* newest = nullptr; ///< the newest message, maybe still arriving
    std::uint64_t messages = 0;              ///< begun so far
    std::size_t incompleteMessages = 0;      ///< of the newest 64, without the newest
    log::Duration repetition{};              ///< median time between messages, 0 where unknown
};

/// The scale messages of one character over time, as far as they differ. Bounded: the oldest go first.
class NullPoseHistory {
public:
    static constexpr std::size_t kMost = 64;

    void add(const wire::NullPose& part, std::uint8_t datagramCounter, std::uint64_t packet,
             log::Stamp stamp);

    /// As of a packet number; null where there was none by then. What is older than the history counts as its
    /// oldest.
    [[nodiscard]] const NullPose* at(std::uint64_t packet) const;
    /// The same with its circumstances.
    [[nodiscard]] NullPoseRecord record(std::uint64_t packet) const;

private:
    struct Version {
        std::uint64_t firstPacket;
        log::Stamp firstStamp;
        NullPose pose;
    };
    void note();
    void keep(const NullPose& pose, std::uint64_t packet, log::Stamp stamp);
    [[nodiscard]] const Version* versionAt(std::uint64_t packet) const;

    NullPoseAssembler m_assembler;
    std::deque<Version> m_versions;
    std::deque<NullPoseMessage> m_messages;
    std::uint64_t m_messageCount = 0;
};

} // namespace posewire::model
