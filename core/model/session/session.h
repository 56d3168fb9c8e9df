// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet_log.h"
#include "core/log/stream_index.h"
#include "core/model/accounting/attribution.h"
#include "core/model/accounting/event_follower.h"
#include "core/model/accounting/packet_digest.h"
#include "core/model/accounting/stream.h"
#include "core/model/accounting/time_range.h"
#include "core/model/body/character_pose.h"
#include "core/model/body/null_pose.h"
#include "core/model/keys.h"
#include "core/model/session/annotations.h"
#include "core/model/session/metadata.h"
#include "core/model/session/sender.h"

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace posewire::model {

/// One character of a sender.
struct Character {
    CharacterKey key;
    std::size_t ordinal = 0; ///< place in the order of first appearance, for default colours
    Metadata metadata;
    NullPoseHistory nullPoses;
    std::int64_t lastStampNs = 0;
    std::uint64_t firstPacket = 0;
    std::uint64_t lastPacket = 0;
    std::optional<CharacterKey> before; ///< see Session::predecessor
    std::optional<CharacterKey> after;  ///< who has this one as `before`
};

/// Where in time the operator looks.
struct Cursor {
    enum class Mode : std::uint8_t { Following, Paused };
    Mode mode = Mode::Following;
    std::uint64_t packet = 0; ///< paused: the newest packet that counts
};

/// What is selected; part of the session, so that all panels agree without knowing each other.
struct Selection {
    std::optional<log::SenderId> sender{};
    std::optional<CharacterKey> character{};
    int segment = -1;                      ///< position in the pose datagram, -1 for none
    std::optional<std::uint64_t> packet{}; ///< its number in the log; nothing: the newest one
    friend bool operator==(const Selection&, const Selection&) = default;
};

/// Follows a PacketLog: index, statistics, metadata, null poses. Everything is a view of the log at the
/// cursor; nothing is kept that could not be read again from the log, except counts. One thread.
///
/// Senders, characters and streams are in order of first appearance and are never removed, so that rows do
/// not jump; their number is bounded by the log's own limits (4,096 senders and streams).
class Session {
public:
    explicit Session(const log::PacketLog& log);

    /// Reads at most `most` new packets; true if there were any. `nowNs` (wall clock) is what ages are
    /// measured against.
    bool follow(std::int64_t nowNs, std::size_t most = 200'000);

    void setCursor(Cursor cursor) { m_cursor = cursor; }
    void setSelection(const Selection& selection) { m_selection = selection; }
    /// What time statistics are of. Apart from the selection, so that it stays while others select.
    void setRange(const RangeChoice& range) { m_range = range; }
    /// Holds for what comes from now on.
    void setThresholds(const Thresholds& thresholds) { m_follower.setThresholds(thresholds); }
    /// What packets are listed; in the filter language, empty for all. It is not checked here.
    void setDisplayFilter(std::string filter) { m_displayFilter = std::move(filter); }
    /// What the operator declares about a sender counts instead of what was detected, also for the senders
    /// that follow it on the same host. Nothing happens where there is no such sender.
    void setOverride(log::SenderId sender, const SenderOverride& overrides);
    void setMarked(std::uint64_t packet, bool isMarked);
    /// An empty comment takes the comment away.
    void setComment(std::uint64_t packet, std::string comment);

    // What panels read (SessionView is this class as const).
    [[nodiscard]] const std::deque<Sender>& senders() const { return m_senders; }
    [[nodiscard]] const std::deque<Character>& characters() const { return m_characters; }
    [[nodiscard]] const std::deque<Stream>& streams() const { return m_streams; }
    [[nodiscard]] const Sender* find(log::SenderId id) const;
    [[nodiscard]] const Character* find(const CharacterKey& key) const;
    [[nodiscard]] const Stream* find(const log::StreamKey& key) const;

    /// Sums over the streams of a character, a sender, or all, without what makes no sense of several.
    [[nodiscard]] StreamCounts countsOf(const CharacterKey& key) const;
    [[nodiscard]] StreamCounts countsOf(log::SenderId id) const;
    [[nodiscard]] StreamCounts countsOf(const CharacterKey& key, const TimeRange& range) const;
    [[nodiscard]] StreamCounts countsOf(log::SenderId id, const TimeRange& range) const;
    [[nodiscard]] StreamCounts countsBetween(const TimeRange& range) const;

    /// What happened, in the time of the log; with conditions that go on.
    [[nodiscard]] const Events& events() const { return m_follower.events(); }
    [[nodiscard]] const Thresholds& thresholds() const { return m_follower.thresholds(); }
    /// What goes on at the cursor and concerns a character or its sender, worst first.
    [[nodiscard]] std::vector<const Event*> troublesOf(const CharacterKey& key) const {
        return m_follower.troublesOf(key, pausedStampNs());
    }
    /// How a character does at the cursor: the one rule for all who show it. By the worst of what goes on;
    /// else by its silence, or a warning where what its sender says does not fit together.
    [[nodiscard]] Condition conditionOf(const CharacterKey& key) const;

    /// Every gap in a stream with whose loss it was; the newest ones.
    [[nodiscard]] const Attribution& attribution() const { return m_attribution; }
    [[nodiscard]] const std::deque<Gap>& gaps() const { return m_attribution.gaps(); }

    /// A sender that starts again has another port, and some senders use a port for each kind of message. So
    /// a character of the same host with the same ID that fell silent before this one came is the same
    /// person: what this one has not sent yet is taken from there. Null where there is none, or where both
    /// turned out to send at the same time.
    [[nodiscard]] const Character* predecessor(const CharacterKey& key) const;

    /// True where another sender has taken over at the cursor; its character is shown instead of this one.
    [[nodiscard]] bool isSuperseded(const CharacterKey& key) const { return current(key) != key; }

    /// The one that is shown for a character: itself, or the newest that has taken over.
    [[nodiscard]] CharacterKey current(const CharacterKey& key) const;

    /// Everybody who is to be shown at the cursor, in order of first appearance.
    [[nodiscard]] std::vector<const Character*> currentCharacters() const;

    [[nodiscard]] const Cursor& cursor() const { return m_cursor; }
    [[nodiscard]] const Selection& selection() const { return m_selection; }
    [[nodiscard]] const RangeChoice& rangeChoice() const { return m_range; }
    /// The range that was chosen, as it is at the cursor; nothing for all there is.
    [[nodiscard]] std::optional<TimeRange> range() const;
    [[nodiscard]] const std::string& displayFilter() const { return m_displayFilter; }
    [[nodiscard]] const Annotations& annotations() const { return m_annotations; }
    [[nodiscard]] std::int64_t nowNs() const { return m_nowNs; }
    /// Packets followed so far: one past the newest packet number.
    [[nodiscard]] std::uint64_t end() const { return m_end; }
    [[nodiscard]] std::uint64_t begin() const { return m_begin; }
    /// Of the first packet that was followed, also where the log has dropped it; 0 before there is one.
    [[nodiscard]] std::int64_t firstStampNs() const { return m_firstStampNs; }
    [[nodiscard]] log::LogFigures figures() const { return m_log.figures(); }

    /// For readers on other threads.
    [[nodiscard]] const log::PacketLog& log() const { return m_log; }
    /// Nothing where the log has dropped it. The bytes are valid until the next follow().
    [[nodiscard]] std::optional<log::Packet> packet(std::uint64_t number) const {
        return m_reader.packet(number);
    }
    /// One for every packet from begin() to end().
    [[nodiscard]] const PacketDigests& digests() const { return m_digests; }

    /// The newest complete message of a stream at the cursor, decoded; null where there is none or it cannot
    /// be decoded. Items of a sample that came in several datagrams are joined. Valid until the next follow()
    /// or message() of the same stream.
    struct Message {
        wire::Datagram datagram;
        std::int64_t stampNs = 0;
        std::uint64_t packet = 0;
    };
    [[nodiscard]] const Message* message(const CharacterKey& key, std::uint8_t type) const;

    /// Reads the messages of a stream from a stamp up to the cursor, oldest first, at most the newest `most`
    /// of them. Datagrams that cannot be decoded or are one of several of a sample are left out. Returns how
    /// many were visited.
    std::size_t visit(const log::StreamKey& key, std::int64_t fromStampNs, std::size_t most,
                      const std::function<void(const Message&)>& visitor) const;

    /// The newest pose at the cursor, of type 02, 01 or 05: the first of these that is not more than 0.25 s
    /// older than the newest of them, so that a figure does not jump between types that are sent together.
    [[nodiscard]] const CharacterPose* pose(const CharacterKey& key) const;

    /// What type 12 messages said about a character, or about its predecessor where it has sent none itself.
    /// The character must be one of this session.
    [[nodiscard]] const Metadata& metadata(const CharacterKey& key) const;

    /// The scale message at the cursor; null where none was received.
    [[nodiscard]] const NullPose* nullPose(const CharacterKey& key) const;

    /// Null pose at the cursor: 23 origins in metres; the reference body where none was received.
    [[nodiscard]] std::vector<Eigen::Vector3d> bodyOrigins(const CharacterKey& key) const;

    /// "Factory", or "Character 1" where no name was sent.
    [[nodiscard]] std::string displayName(const CharacterKey& key) const;
    [[nodiscard]] Colour colour(const CharacterKey& key) const;

    /// Seconds since the newest datagram of the character, against nowNs() or, paused, the stamp at the
    /// cursor.
    [[nodiscard]] double ageSeconds(const CharacterKey& key) const;

    /// The newest packet that had been received by then; the oldest there is where all came later.
    [[nodiscard]] std::uint64_t packetAt(std::int64_t stampNs) const;

    /// Stamp that "now" means at the cursor: nowNs() when following, the packet's stamp when paused.
    [[nodiscard]] std::int64_t cursorStampNs() const;

private:
    void take(const log::Packet& packet);
    void takeFrom(const log::Packet& packet, Sender& sender, PacketDigest& digest);
    void takeDatagram(const log::Packet& packet, Sender& sender, PacketDigest& digest);
    void takeMalformed(const log::Packet& packet, Sender& sender, const PacketDigest& digest);
    void takeContent(const log::Packet& packet, Character& character, Sender& sender);
    // Null where there are too many already.
    Sender* senderOf(const log::Packet& packet);
    Character* characterOf(const CharacterKey& key, std::uint64_t packetNumber);
    Stream* streamOf(const log::StreamKey& key, const Sender& sender);
    [[nodiscard]] std::uint64_t visibleEnd() const;
    /// The cursor's time where it stands still; nothing where it follows the log.
    [[nodiscard]] std::optional<std::int64_t> pausedStampNs() const;
    template <class Selected, class Counts>
    [[nodiscard]] StreamCounts sumOf(Selected isSelected, Counts counts) const;
    [[nodiscard]] std::optional<CharacterKey> lastOfSameHost(const CharacterKey& key) const;
    [[nodiscard]] std::string_view metadataValue(const CharacterKey& key, std::string_view tag) const;
    [[nodiscard]] const log::StreamEntries* entries(const log::StreamKey& key) const {
        return m_index.find(key);
    }
    [[nodiscard]] std::size_t visibleCount(const log::StreamEntries& entries) const;
    bool readMessage(const log::StreamEntries& entries, std::size_t count, Message& message) const;
    bool readWhole(const log::StreamEntry& entry, Message& message) const;

    struct StreamOrder {
        bool operator()(const log::StreamKey& a, const log::StreamKey& b) const {
            return std::tie(a.sender, a.character, a.type) < std::tie(b.sender, b.character, b.type);
        }
    };
    struct CachedMessage {
        std::uint64_t packet = UINT64_MAX; ///< the newest datagram it was made from
        bool isValid = false;
        Message message;
    };
    struct CachedPose {
        std::uint64_t packet = UINT64_MAX;
        bool isValid = false;
        CharacterPose pose;
    };

    const log::PacketLog& m_log;
    mutable log::LogReader m_reader;
    log::StreamIndex m_index;
    std::uint64_t m_begin = 0;
    std::uint64_t m_end = 0;
    std::int64_t m_nowNs = 0;
    std::int64_t m_firstStampNs = 0;
    Cursor m_cursor;
    Selection m_selection;
    RangeChoice m_range;
    std::string m_displayFilter;
    Annotations m_annotations;
    PacketDigests m_digests;
    std::deque<Sender> m_senders;
    std::deque<Character> m_characters;
    std::deque<Stream> m_streams;
    Attribution m_attribution{m_streams};
    EventFollower m_follower;
    bool m_isLive = false; ///< packets have come as they were stamped
    std::map<CharacterKey, std::size_t> m_characterIndex;
    std::map<log::StreamKey, std::size_t, StreamOrder> m_streamIndex;
    std::map<log::SenderId, std::size_t> m_senderIndex;
    mutable std::map<log::StreamKey, CachedMessage, StreamOrder> m_messages;
    mutable std::map<CharacterKey, CachedPose> m_poses;
    wire::Datagram m_scratch;
    mutable Message m_part;
    mutable Message m_visited;
};

/// What a panel may do with the session: read it.
using SessionView = const Session;

} // namespace posewire::model
