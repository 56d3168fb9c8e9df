// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/log_reader.h"
#include "core/log/packet_log.h"
#include "core/log/stream_index.h"
#include "core/log/time.h"
#include "core/model/accounting/packet_digest.h"
#include "core/model/accounting/stream.h"
#include "core/model/accounting/stream_figures.h"
#include "core/model/foreign_text.h"
#include "core/model/keeping.h"
#include "core/model/message.h"
#include "core/model/roster.h"
#include "core/model/session/memory_figures.h"
#include "core/model/session/sender.h"
#include "core/model/session/unconfirmed.h"

#include <array>
#include <deque>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace posewire::model {

class Attribution;
struct Occurrence;
class IncidentFollower;
class NullPoseHistory;
struct NullPoseRecord;
struct Thresholds;

/// Sums over senders.
struct SenderTotals {
    std::uint64_t senders = 0;
    std::uint64_t datagrams = 0;
    std::uint64_t bytes = 0;
    std::uint64_t malformed = 0;
    std::uint64_t foreign = 0;
    std::uint64_t kernelDrops = 0;

    void add(const Sender& sender);
    /// Datagrams that could be decoded.
    [[nodiscard]] std::uint64_t wellFormed() const { return datagrams - malformed - foreign; }
};

/// Sums over the senders that were retired.
struct RetiredTotals : SenderTotals {
    std::uint64_t streams = 0;
    std::uint64_t samples = 0;
    std::uint64_t lost = 0; ///< without incomplete ones
    /// The worst of their streams by the figures that limits are set on.
    struct Worst {
        Figure figure{};
        double value = 0;
        log::StreamKey stream{};
    };
    std::array<Worst, 3> worst{{{Figure::LossShare}, {Figure::Jitter}, {Figure::SpacingMost}}};

    void retire(const Sender& sender);
};

/// What a sender that was retired was called.
struct FormerSender {
    log::SenderId id{};
    std::string address;
    std::vector<std::pair<std::uint8_t, ForeignText>> names; ///< by character, of those that had one
};

/// Follows a PacketLog: who sends, which streams there are, what is missing of them and why, what happened.
/// Every packet is observed once, in the order of the log, and passes one stage after the other; its body is
/// decoded once, since malformed datagrams and notices are counted, and that value is what all stages read.
/// Nothing is kept that could not be read again from the log, except counts. One thread.
///
/// Senders, characters and streams are in order of first appearance. Where there are too many, the sender
/// that has been silent longest is retired with all that is its own, and remembered in sums; who has sent
/// nothing but strange bytes takes no place that a performance could need.
class Ingest {
public:
    static constexpr std::size_t kMostSenders = 512;
    static constexpr std::size_t kMostStrangers = 128; ///< senders of nothing that could be decoded
    static constexpr std::size_t kMostCharacters = 1024;
    static constexpr std::size_t kMostStreams = log::StreamIndex::kStreamLimit;
    /// A sender with more streams than these is no performance.
    static constexpr std::size_t kMostStreamsOfSender = 1024;
    /// A stream's newest datagram is kept as it was decoded where it is not larger: the largest legal one has
    /// less than 3,000 bytes.
    static constexpr std::size_t kMostNewestBytes = 4096;
    /// Of the history of a sender's malformed datagrams.
    static constexpr std::size_t kBucketsOfSender = 256;
    /// Of all characters together: what they hold goes, oldest first, where it would be more.
    static constexpr std::size_t kMetadataBudget = std::size_t{8} << 20;
    /// Retired senders that incidents can still name, the newest, and characters of each.
    static constexpr std::size_t kMostFormer = 256;
    static constexpr std::size_t kMostFormerNames = 32;
    static constexpr log::Duration kForgettable = std::chrono::seconds(1);
    static constexpr std::size_t kNullPoseBudget = std::size_t{16} << 20;

    explicit Ingest(const log::PacketLog& log);
    ~Ingest();

    /// Reads at most `most` new packets; true if there were any.
    bool follow(log::Stamp now, std::size_t most);
    void setHeldUp(bool isHeldUp) { m_isHeldUp = isHeldUp; }
    /// The same while a file is read: however new its packets are, silence after them is no silence.
    bool followFile(log::Stamp now, std::size_t most);
    /// Nothing more is read: what is not there by now is lost.
    void settle();
    /// All that was read is a file that has ended: nobody in it is expected to send on after the time that
    /// went by after its last packet while it was recorded.
    void endFile(log::Duration afterLast);

    void setThresholds(const Thresholds& thresholds);
    /// Something that no packet tells: it happened in this computer.
    void report(const Occurrence& one);
    void setOverride(log::SenderId sender, const SenderOverride& overrides);
    /// Retires a sender from which nothing more is expected: others have taken over its characters, or it has
    /// been silent for kForgettable. False, and nothing happens, where it is neither.
    bool forget(log::SenderId sender);
    [[nodiscard]] bool isForgettable(log::SenderId sender) const;
    /// Whether others have taken over all characters of a sender.
    [[nodiscard]] bool hasEnded(const Sender& sender) const;
    /// Whether what was followed last is a file.
    [[nodiscard]] bool isFile() const { return m_isFile; }

    [[nodiscard]] const Roster<log::SenderId, Sender>& senders() const { return m_senders; }
    [[nodiscard]] const Roster<CharacterKey, Character>& characters() const { return m_characters; }
    [[nodiscard]] const Roster<log::StreamKey, Stream>& streams() const { return m_streams; }
    [[nodiscard]] const Sender* find(log::SenderId id) const { return m_senders.find(id); }
    [[nodiscard]] const Character* find(const CharacterKey& key) const { return m_characters.find(key); }
    [[nodiscard]] const Stream* find(const log::StreamKey& key) const { return m_streams.find(key); }
    /// Null where no scale message came.
    [[nodiscard]] const NullPoseHistory* nullPoses(const CharacterKey& key) const;
    /// What metadata and null poses of all characters take, about.
    [[nodiscard]] std::size_t metadataBytes() const;
    [[nodiscard]] std::size_t nullPoseBytes() const;
    /// What is kept of all that came, and its limits.
    [[nodiscard]] MemoryFigures memory() const;
    /// The newest datagram of a stream as it was decoded; null where it was malformed, is of a type that does
    /// not count samples, or is larger than kMostNewestBytes.
    [[nodiscard]] const Message* newest(const log::StreamKey& key) const;

    /// Those that made room; grows whenever rows go.
    [[nodiscard]] const RetiredTotals& retired() const { return m_retired; }
    /// Null where it is not one of the newest.
    [[nodiscard]] const FormerSender* former(log::SenderId id) const;
    /// Datagrams of streams and characters beyond what is followed: they are in the log, and nowhere else.
    [[nodiscard]] std::uint64_t unfollowed() const { return m_unfollowed; }
    /// See SessionView.
    [[nodiscard]] log::Duration behind() const;
    /// Packets that the log had dropped before they were looked at.
    [[nodiscard]] std::uint64_t overtaken() const { return m_follower.overtaken() - m_dropRecordsUnseen; }
    /// Datagrams that this computer dropped among those: of no sender that is known.
    [[nodiscard]] std::uint64_t dropsUnseen() const { return m_dropsUnseen; }

    [[nodiscard]] const IncidentFollower& incidents() const { return *m_incidents; }
    /// The number of the incident that the pending gaps of a sender may become.
    [[nodiscard]] std::uint64_t provisionalNumber(log::SenderId sender);
    [[nodiscard]] const Attribution& attribution() const { return *m_attribution; }
    [[nodiscard]] const PacketDigests& digests() const { return m_digests; }
    [[nodiscard]] const log::StreamIndex& index() const { return m_index; }
    [[nodiscard]] const log::PacketLog& log() const { return m_log; }
    /// Packets as of the last follow().
    [[nodiscard]] log::LogReader& reader() { return m_follower.reader(); }

    [[nodiscard]] log::Stamp now() const { return m_now; }
    /// Of a file its end, however long ago that was.
    [[nodiscard]] log::Stamp knownUntil() const { return m_isFile ? std::max(m_observed, m_fileEnd) : m_now; }
    [[nodiscard]] std::uint64_t begin() const { return m_begin; }
    [[nodiscard]] std::uint64_t end() const { return m_follower.position(); }
    [[nodiscard]] log::Stamp firstStamp() const { return m_firstStamp; }

private:
    using Recency = std::list<log::SenderId>; ///< longest silent first
    struct Place {
        Recency* list;
        Recency::iterator at;
    };

    /// A packet on its way through the stages.
    struct Observation {
        const log::Packet& packet;
        std::optional<wire::Header> header{};     ///< nothing where it cannot be read
        const wire::Datagram* datagram = nullptr; ///< null where it cannot be decoded
        PacketDigest digest{};
        Sender* sender = nullptr; ///< null where the log does not know it
        Stream* stream = nullptr;
        Character* character = nullptr;
    };

    /// How many it took.
    std::size_t takeNew(log::Stamp now, std::size_t most);
    /// Silence after the newest packet, at moments that follow from its stamp alone: what is found, and in
    /// which order, is the same however often it is looked.
    void passTime(log::Stamp until);
    void advance(log::Stamp stamp);
    // The stages, in this order. Those from takeHeader() on are for datagrams that could be decoded.
    void take(const log::Packet& packet);
    void takeOvertaken(std::uint64_t count, const log::Packet* next);
    void takeDropsUnseen(std::uint64_t count, const log::Packet& next);
    void observe(Observation& seen);
    void countPacket(const Observation& seen);
    void passOverDropped(const Observation& seen);
    void judgeGaps(const Observation& seen);
    void amendGaps();
    void countFaulty(const Observation& seen);
    [[nodiscard]] bool takeHeader(Observation& seen);
    void account(Observation& seen);
    void takeVerdict(Stream& stream, const Verdict& verdict, bool isConfirmed);
    void takeContent(const Observation& seen);

    void lookForContradictions();
    void lookAtNullPose(const NullPoseRecord& record, Character& character, const log::Packet& packet);
    void takeMetadata(const wire::MetaData& message, const Observation& seen);
    void takeNullPose(const wire::NullPose& part, const Observation& seen);
    // Null where there are too many already.
    Sender* senderOf(const log::Packet& packet);
    Character* characterOf(Sender& sender, std::uint8_t character, std::uint64_t packetNumber);
    Stream* streamOf(const log::StreamKey& key, const Sender& sender);
    [[nodiscard]] Character* predecessorOf(const Character& character);
    void forgetHostOf(const Sender& sender);

    // Making room.
    [[nodiscard]] AccountingDepth depthNow() const;
    void fitDepth();
    void promote(const Sender& sender);
    bool retireSilent();
    void retireOldest(const Recency& recency, std::size_t count);
    void retire(const std::unordered_set<log::SenderId>& going);
    [[nodiscard]] Character* heirOf(const Character& character);
    void bequeath(const Character& character);
    void remember(const Sender& sender);

    const log::PacketLog& m_log;
    log::LogFollower m_follower;
    log::StreamIndex m_index;
    std::uint64_t m_begin = 0;
    std::uint64_t m_dropsUnseen = 0;
    std::uint64_t m_dropRecordsUnseen = 0;
    log::Stamp m_now{};
    log::Stamp m_firstStamp{};
    log::Stamp m_observed{}; ///< of the newest packet
    log::Stamp m_fileEnd{};
    log::Stamp m_moment{}; ///< at which silence after it is looked at next
    PacketDigests m_digests;
    Roster<log::SenderId, Sender> m_senders;
    Roster<CharacterKey, Character> m_characters;
    Roster<log::StreamKey, Stream> m_streams;
    Recency m_performers; ///< have sent a few datagrams at least
    Recency m_newcomers;  ///< have sent one that could be decoded
    Recency m_strangers;  ///< have not
    std::unordered_map<log::SenderId, Place> m_recencies;
    std::unordered_map<log::SenderId, std::uint64_t> m_passersBy; ///< datagrams of retired senders
    std::unordered_map<std::string, log::SenderId> m_newestOfHost;
    std::map<std::pair<std::string, std::uint8_t>, std::deque<CharacterKey>> m_namesakes; ///< by host and ID
    std::size_t m_characterCount = 0; ///< that there ever were
    AccountingDepth m_depth;
    RetiredTotals m_retired;
    std::deque<FormerSender> m_former; ///< oldest first
    std::uint64_t m_unfollowed = 0;
    Unconfirmed m_unconfirmed;
    Message m_unplaced; ///< what a datagram is decoded into whose stream is not known yet
    std::map<CharacterKey, std::shared_ptr<NullPoseHistory>> m_nullPoses;
    Keeping m_metadataKeeping{kMetadataBudget};
    Keeping m_nullPoseKeeping{kNullPoseBudget};
    std::unique_ptr<IncidentFollower> m_incidents;
    std::unique_ptr<Attribution> m_attribution; ///< tells them of losses
    log::Stamp m_nextContradictions{};
    bool m_isFile = false;
    bool m_isHeldUp = false; ///< only packets tell what time it is
    bool m_isLive = false;   ///< packets have come as they were stamped
};

} // namespace posewire::model
