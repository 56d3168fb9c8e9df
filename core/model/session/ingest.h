// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet_log.h"
#include "core/log/stream_index.h"
#include "core/log/time.h"
#include "core/model/accounting/packet_digest.h"
#include "core/model/accounting/stream.h"
#include "core/model/keeping.h"
#include "core/model/session/sender.h"

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <unordered_map>

namespace posewire::model {

class Attribution;
class EventFollower;
class NullPoseHistory;
struct Thresholds;

/// A complete message, decoded. Items of a sample that came in several datagrams are joined.
struct Message {
    wire::Datagram datagram;
    log::Stamp stamp{};
    std::uint64_t packet = UINT64_MAX; ///< its number in the log; of the last of several datagrams
    log::SenderId sender{};
};

/// Follows a PacketLog: who sends, which streams there are, what is missing of them and why, what happened.
/// Every packet is observed once, in the order of the log, and passes one stage after the other; its body is
/// decoded once, since malformed datagrams and notices are counted, and that value is what all stages read.
/// Nothing is kept that could not be read again from the log, except counts. One thread.
///
/// Senders, characters and streams are in order of first appearance and are never removed, so that rows do
/// not jump; their number is bounded by the log's own limits (4,096 senders and streams).
class Ingest {
public:
    /// Of all characters together: what they hold goes, oldest first, where it would be more.
    static constexpr std::size_t kMetadataBudget = std::size_t{8} << 20;
    static constexpr std::size_t kNullPoseBudget = std::size_t{16} << 20;

    explicit Ingest(const log::PacketLog& log);
    ~Ingest();

    /// Reads at most `most` new packets; true if there were any.
    bool follow(log::Stamp now, std::size_t most);
    /// Reads all new packets as those of a file that has ended: nobody in it is expected to send on.
    void followFile();

    void setThresholds(const Thresholds& thresholds);
    void setOverride(log::SenderId sender, const SenderOverride& overrides);

    [[nodiscard]] const std::deque<Sender>& senders() const { return m_senders; }
    [[nodiscard]] const std::deque<Character>& characters() const { return m_characters; }
    [[nodiscard]] const std::deque<Stream>& streams() const { return m_streams; }
    [[nodiscard]] const Sender* find(log::SenderId id) const;
    [[nodiscard]] const Character* find(const CharacterKey& key) const;
    [[nodiscard]] const Stream* find(const log::StreamKey& key) const;
    /// Null where no scale message came.
    [[nodiscard]] const NullPoseHistory* nullPoses(const CharacterKey& key) const;
    /// What metadata and null poses of all characters take, about.
    [[nodiscard]] std::size_t metadataBytes() const;
    [[nodiscard]] std::size_t nullPoseBytes() const;
    /// The newest datagram of a stream as it was decoded; null where it was malformed or is of no known type.
    [[nodiscard]] const Message* newest(const log::StreamKey& key) const;

    [[nodiscard]] const EventFollower& follower() const { return *m_follower; }
    [[nodiscard]] const Attribution& attribution() const { return *m_attribution; }
    [[nodiscard]] const PacketDigests& digests() const { return m_digests; }
    [[nodiscard]] const log::StreamIndex& index() const { return m_index; }
    [[nodiscard]] const log::PacketLog& log() const { return m_log; }
    /// Packets as of the last follow().
    [[nodiscard]] log::LogReader& reader() { return m_reader; }

    [[nodiscard]] log::Stamp now() const { return m_now; }
    [[nodiscard]] std::uint64_t begin() const { return m_begin; }
    [[nodiscard]] std::uint64_t end() const { return m_end; }
    [[nodiscard]] log::Stamp firstStamp() const { return m_firstStamp; }

private:
    /// A packet on its way through the stages.
    struct Observation {
        const log::Packet& packet;
        std::optional<wire::Header> header{};     ///< nothing where it cannot be read
        const wire::Datagram* datagram = nullptr; ///< null where it cannot be decoded
        PacketDigest digest{};
        Sender* sender = nullptr; ///< null where there are too many
        std::optional<std::size_t> stream{};
        Character* character = nullptr;
    };

    // The stages, in this order. Those from takeHeader() on are for datagrams that could be decoded.
    void take(const log::Packet& packet);
    void observe(Observation& seen);
    void countPacket(const Observation& seen);
    void judgeGaps(const Observation& seen);
    void countFaulty(const Observation& seen);
    [[nodiscard]] bool takeHeader(Observation& seen);
    void account(Observation& seen);
    void takeContent(const Observation& seen);

    void takeMetadata(const wire::MetaData& message, const Observation& seen);
    void takeNullPose(const wire::NullPose& part, const Observation& seen);
    // Null, or nothing, where there are too many already.
    Sender* senderOf(const log::Packet& packet);
    Character* characterOf(const CharacterKey& key, std::uint64_t packetNumber);
    std::optional<std::size_t> addStream(const log::StreamKey& key, const Sender& sender);
    [[nodiscard]] std::optional<std::size_t> placeOf(const log::StreamKey& key) const;
    [[nodiscard]] std::optional<CharacterKey> lastOfSameHost(const CharacterKey& key) const;

    const log::PacketLog& m_log;
    log::LogReader m_reader;
    log::StreamIndex m_index;
    std::uint64_t m_begin = 0;
    std::uint64_t m_end = 0;
    log::Stamp m_now{};
    log::Stamp m_firstStamp{};
    PacketDigests m_digests;
    std::deque<Sender> m_senders;
    std::deque<Character> m_characters;
    std::deque<Stream> m_streams;
    std::deque<Message> m_newest; ///< of each stream: what its datagrams are decoded into
    Message m_unplaced;           ///< the same for a datagram whose stream is not known yet
    std::map<CharacterKey, std::shared_ptr<NullPoseHistory>> m_nullPoses;
    Keeping m_metadataKeeping{kMetadataBudget};
    Keeping m_nullPoseKeeping{kNullPoseBudget};
    std::unique_ptr<Attribution> m_attribution;
    std::unique_ptr<EventFollower> m_follower;
    bool m_isLive = false; ///< packets have come as they were stamped
    std::map<CharacterKey, std::size_t> m_characterPlaces;
    std::unordered_map<log::StreamKey, std::size_t> m_streamPlaces;
    std::map<log::SenderId, std::size_t> m_senderPlaces;
};

} // namespace posewire::model
