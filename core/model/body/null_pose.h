// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/foreign_text.h"
#include "core/model/keeping.h"
#include "core/wire/messages.h"

#include <Eigen/Core>

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace posewire::model {

struct NullPoseMessage {
    std::uint64_t firstPacket = 0; ///< number of the part that came first
    log::Stamp firstStamp{};       ///< its stamp
    log::Stamp stamp{};            ///< of the newest part
    unsigned partsReceived = 0;
    unsigned partsExpected = 0;         ///< 0 as long as the last part has not arrived
    std::vector<unsigned> missingParts; ///< places from 0, below the last one that is known of
    std::size_t leftOut = 0;            ///< segments and points beyond NullPose::kMostBytes

    [[nodiscard]] bool isComplete() const { return partsExpected != 0 && partsReceived == partsExpected; }
};

/// A scale message put together from its datagrams (type 13): the null pose, a T-pose with all orientations
/// identity.
struct NullPose : NullPoseMessage {
    /// Segments and points that take more memory are left out; those of MVN take a tenth of it.
    static constexpr std::size_t kMostBytes = 256 * 1024;
    /// Of longer names only what is shown is kept.
    static constexpr std::size_t kMostNameBytes = 1024;

    struct Segment {
        ForeignText name; ///< as sent
        /// What people read: see segmentTitle; the name where the specification has no such segment.
        [[nodiscard]] std::string title() const;
        Eigen::Vector3d position; ///< metres, Z-up, world
        friend bool operator==(const Segment&, const Segment&) = default;
    };
    struct Point {
        int segment = 0; ///< wire ID, 1-based
        int id = 0;      ///< within the segment
        ForeignText name;
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
/// parts may come in any order and more than once; a part without segments adds to what is there. What a part
/// costs is bounded by NullPose::kMostBytes, however many came before it.
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
    [[nodiscard]] const NullPose* newest() const { return m_settled.get(); }
    [[nodiscard]] const std::shared_ptr<const NullPose>& settled() const { return m_settled; }

    /// The message that is arriving; differs from newest() until it is complete, and is without its segments
    /// and points then.
    [[nodiscard]] const NullPose& arriving() const { return m_arriving; }

    [[nodiscard]] std::size_t memoryBytes() const;
    /// Gives up all that has come.
    void forget();

private:
    struct Part {
        std::uint64_t hash = 0; ///< of what was sent
        std::size_t segments = 0;
        std::size_t points = 0;
    };
    void begin(std::uint64_t packet, log::Stamp stamp);
    [[nodiscard]] bool isOvertaken(log::Stamp stamp) const;
    [[nodiscard]] Part take(const wire::NullPose& part, std::size_t index);
    void settle();

    NullPose m_arriving;
    std::size_t m_bytes = 0; ///< of its segments and points
    std::shared_ptr<const NullPose> m_settled;
    std::vector<std::optional<Part>> m_parts; ///< by place
};

/// Valid until the history grows.
struct NullPoseRecord {
    const NullPose* pose = nullptr;          ///< null if there was none by then
    const NullPose* before = nullptr;        ///< the newest that differs, null if none does
    log::Stamp changed{};                    ///< when `pose` came first
    const NullPoseMessage* newest = nullptr; ///< the newest message, maybe still arriving
    std::uint64_t messages = 0;              ///< begun so far
    std::size_t incompleteMessages = 0;      ///< of the newest 64, without the newest
    log::Duration repetition{};              ///< median time between messages, 0 if unknown
};

/// The scale messages of one character over time, as far as they differ; the same body is kept once however
/// often it comes. Bounded: the oldest go first. Who keeps many of these keeps them within a budget
/// (keepWithin).
class NullPoseHistory {
public:
    static constexpr std::size_t kMostVersions = 32; ///< 16 bodies: each may have two, see keep()
    static constexpr std::size_t kMostMessages = 64;

    /// True if it makes another body of what was known before.
    bool add(const wire::NullPose& part, std::uint8_t datagramCounter, std::uint64_t packet,
             log::Stamp stamp);

    /// As of a packet number; null if there was none by then. What is older than the history counts as its
    /// oldest.
    [[nodiscard]] const NullPose* at(std::uint64_t packet) const;
    [[nodiscard]] NullPoseRecord record(std::uint64_t packet) const;

    /// Calls f(first packet, pose) for each body that is kept, the oldest first.
    template <class F>
    void forEach(F&& f) const {
        for (const Version& version : m_versions) {
            f(version.firstPacket, *version.pose);
        }
    }

    /// Versions that were given up.
    [[nodiscard]] std::uint64_t dropped() const { return m_dropped; }

    [[nodiscard]] std::size_t memoryBytes() const;
    /// What is older goes first, the body that is known now last.
    [[nodiscard]] std::optional<Droppable> oldest() const;
    /// Returns the bytes that are free now.
    std::size_t dropOldest();

private:
    struct Version {
        std::uint64_t firstPacket;
        log::Stamp firstStamp;
        std::shared_ptr<const NullPose> pose;
        std::size_t bytes;
        bool isOtherBody; ///< than the version before
    };
    void note();
    bool keep(std::uint64_t packet, log::Stamp stamp);
    void dropVersion();
    [[nodiscard]] std::deque<Version>::const_iterator versionAt(std::uint64_t packet) const;

    NullPoseAssembler m_assembler;
    std::deque<Version> m_versions;
    std::deque<NullPoseMessage> m_messages;
    std::uint64_t m_messageCount = 0;
    std::uint64_t m_dropped = 0;
};

} // namespace posewire::model
