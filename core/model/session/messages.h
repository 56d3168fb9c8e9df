// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/stream_index.h"
#include "core/model/message.h"
#include "core/model/session/roster.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace posewire::model {

struct BodyOrigins;
struct CharacterPose;
struct NullPose;
struct NullPoseEvidence;
struct PoseRemark;
struct RangePart;
struct RangeParts;
struct TagPlace;

/// Messages, bodies and poses at a moment. Reading changes only its memory of what was decoded. What it
/// returns is valid until the session follows the log again, or the same is read of another moment.
///
/// Poses and bodies are declared here and defined in headers of their own.
class Messages {
public:
    /// What was decoded, at most, about: if it is more than a quarter of it, it goes once the session has
    /// followed the log.
    static constexpr std::size_t kMostDecodedBytes = std::size_t{64} << 20;

    /// The roster is of the same moment, and outlives this.
    Messages(const Moment& moment, const Roster& roster);
    ~Messages();

    /// The newest complete message of a stream; null if there is none, it cannot be decoded or is too large
    /// (kMostMessageBytes).
    [[nodiscard]] const Message* message(const CharacterKey& key, std::uint8_t type) const;
    /// Reads the messages of a stream from a stamp on, oldest first, at most the newest `most` of them.
    /// Datagrams that cannot be decoded or are one of several of a sample are left out. Returns how many were
    /// visited.
    std::size_t visit(const log::StreamKey& key, log::Stamp fromStamp, std::size_t most,
                      const std::function<void(const Message&)>& visitor) const;
    /// The same with the headers alone, one of each sample, also of those that were sent in several
    /// datagrams.
    std::size_t visitHeaders(const log::StreamKey& key, log::Stamp fromStamp, std::size_t most,
                             const std::function<void(log::Stamp, const wire::Header&)>& visitor) const;
    /// Adds what arrived of a stream in each part, datagram by datagram: finer than its accounting's buckets.
    /// What was lost is left to SettledLosses. Nothing is added if more than `most` datagrams would have to
    /// be looked at. The moment plays no part.
    void addArrivals(const log::StreamKey& key, const RangeParts& parts, std::size_t most,
                     std::span<RangePart> into) const;
    /// 0 if there is none.
    [[nodiscard]] log::Stamp newestStamp(const log::StreamKey& key) const;
    /// The newest datagram of the sample that is `steps` samples after the one at the moment, or before it;
    /// of the last or the first sample if there are not as many. Nothing if the stream has none.
    [[nodiscard]] std::optional<std::uint64_t> packetOfSample(const log::StreamKey& key, int steps) const;
    /// Seconds since the newest datagram of a character.
    [[nodiscard]] double ageSeconds(const CharacterKey& key) const;
    /// The newest datagram of the oldest sample that is kept.
    [[nodiscard]] std::optional<std::uint64_t> firstSample(const log::StreamKey& key) const;
    /// The datagrams of the newest whole message of types 10 to 13 before a packet.
    [[nodiscard]] std::vector<std::uint64_t> wholeBefore(const log::StreamKey& key,
                                                         std::uint64_t packet) const;
    /// From the type 12 messages of a character, or of its predecessor if it has sent none itself. Empty if
    /// there is no such character.
    [[nodiscard]] const Metadata& metadata(const CharacterKey& key) const;

    /// The newest pose (choosePose, assemble); null without one.
    [[nodiscard]] const CharacterPose* pose(const CharacterKey& key) const;
    [[nodiscard]] PoseRemark poseRemark(const CharacterKey& key) const;
    /// From the scale message; null if none was received.
    [[nodiscard]] const NullPose* nullPose(const CharacterKey& key) const;
    /// MotionGrid tags, each at its latest place, in the order of their ids: those in the newest messages of
    /// types 01 to 03, and of the newest 8,192 datagrams of type 04, which has updated ones alone.
    [[nodiscard]] std::vector<TagPlace> tags(const CharacterKey& key) const;
    /// What the scale messages of a character are judged by, or those of its predecessor if it has sent none
    /// itself.
    [[nodiscard]] NullPoseEvidence nullPoseEvidence(const CharacterKey& key) const;
    /// Of the null pose; without one as measured on poses, else of the reference body.
    [[nodiscard]] const BodyOrigins& bodyOrigins(const CharacterKey& key) const;

    /// Estimates what is kept of all that was decoded.
    [[nodiscard]] std::size_t memoryBytes() const;

private:
    struct Decoded;
    [[nodiscard]] Decoded& decoded() const;
    bool readMessage(const log::StreamEntries& entries, std::size_t count, Message& message) const;
    bool readWhole(const log::StreamEntry& entry, Message& message) const;
    struct PoseOrigin;
    const CharacterPose* poseBefore(const CharacterKey& key, std::size_t place, const Message& newest,
                                    const PoseOrigin& origin) const;
    [[nodiscard]] const Message* messageOfSample(const CharacterKey& key, std::size_t place,
                                                 std::uint32_t sample) const;

    Moment m_moment;
    const Roster& m_roster;
    std::unique_ptr<Decoded> m_decoded;
};

} // namespace posewire::model
