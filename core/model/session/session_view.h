// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/incidents/incidents.h"
#include "core/model/session/choices.h"
#include "core/model/session/ingest.h"

#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace posewire::model {

struct BodyOrigins;
struct CharacterPose;
struct Gap;
struct NullPose;
struct NullPoseEvidence;
struct PendingLoss;
struct PoseRemark;
struct RangePart;
struct RangeParts;
struct TakeVerdict;
struct TakeVerdicts;
struct Thresholds;
struct VerdictSpan;

/// Characters on no list, because a corrupt header may have invented them, and what came of them.
struct Unproven {
    std::size_t characters = 0;
    std::uint64_t datagrams = 0;
};

/// The session as panels, exports and the viewport read it at a moment: what was received by then, and what
/// the operator chose. The moment is the operator's cursor, or now. It changes nothing but its own memory of
/// what it decoded. One thread.
///
/// Poses, bodies and gaps are declared here and defined in headers of their own.
class SessionView {
public:
    ~SessionView();

    /// What was decoded for those who asked, at most, about: where it is more than a quarter of it, it goes
    /// once the session has followed the log.
    static constexpr std::size_t kMostDecodedBytes = std::size_t{64} << 20;

    SessionView(const SessionView&) = delete;
    SessionView& operator=(const SessionView&) = delete;

    /// The session as it is now: this view while the cursor follows, else another of the same session.
    [[nodiscard]] const SessionView& atNow() const { return isPaused() ? *m_atNow : *this; }

    // What was received, whatever the moment.
    [[nodiscard]] const Roster<log::SenderId, Sender>& senders() const { return m_ingest.senders(); }
    [[nodiscard]] const Roster<CharacterKey, Character>& characters() const { return m_ingest.characters(); }
    [[nodiscard]] const Roster<log::StreamKey, Stream>& streams() const { return m_ingest.streams(); }
    [[nodiscard]] const Sender* find(log::SenderId id) const { return m_ingest.find(id); }
    [[nodiscard]] const Character* find(const CharacterKey& key) const { return m_ingest.find(key); }
    [[nodiscard]] const Stream* find(const log::StreamKey& key) const { return m_ingest.find(key); }

    /// Sums over the senders that were retired: their rows are gone.
    [[nodiscard]] const RetiredTotals& retired() const { return m_ingest.retired(); }
    /// Sums over all senders, the retired ones included.
    [[nodiscard]] SenderTotals allSenders() const;
    [[nodiscard]] std::uint64_t unfollowed() const { return m_ingest.unfollowed(); }
    [[nodiscard]] std::uint64_t overtaken() const { return m_ingest.overtaken(); }
    [[nodiscard]] std::uint64_t dropsUnseen() const { return m_ingest.dropsUnseen(); }
    /// "10.0.0.5:40001"; "this computer" for kNoSender; "a retired sender" for one retired long ago.
    [[nodiscard]] ForeignText addressOf(log::SenderId id) const;

    /// What came in a range of time in all streams of a character, without what makes no sense of several.
    [[nodiscard]] StreamCounts countsOf(const CharacterKey& key, const TimeRange& range) const;

    /// What happened, in the time of the log; with conditions that last.
    [[nodiscard]] const Incidents& incidents() const;
    [[nodiscard]] const Thresholds& thresholds() const;
    /// Every gap in a stream with whose loss it was; the newest ones, oldest first.
    [[nodiscard]] const std::deque<Gap>& gaps() const;
    /// Those that are yet to be judged, and samples that are not whole yet.
    void forEachPending(const std::function<void(const PendingLoss&)>& f) const;
    /// Calls f(stream, when it was due, cause, first packet) for the newest samples that came in part.
    void forEachPartialLoss(
        const std::function<void(const log::StreamKey&, log::Stamp, LossCause, std::uint64_t)>& f) const;
    /// What was lost before this is known.
    [[nodiscard]] log::Stamp judgedUntil() const;
    /// What the incident will be called that a sender's pending gaps may become.
    [[nodiscard]] std::uint64_t provisionalNumber(log::SenderId sender) const;
    /// The gap that a packet ended; null where it ended none, or one that is forgotten.
    [[nodiscard]] const Gap* gapEndedBy(std::uint64_t packet) const;
    /// One for every packet from begin() to end().
    [[nodiscard]] const PacketDigests& digests() const { return m_ingest.digests(); }
    /// The end of those that stand; of what comes after, gaps and restarts may yet turn out otherwise.
    [[nodiscard]] std::uint64_t settledEnd() const;

    /// What is kept of all that came, decoded messages included, and its limits: one place decides.
    [[nodiscard]] MemoryFigures memory() const;

    [[nodiscard]] std::uint64_t end() const { return m_ingest.end(); } ///< one past the newest packet
    [[nodiscard]] std::uint64_t begin() const { return m_ingest.begin(); }
    [[nodiscard]] log::Stamp now() const { return m_ingest.now(); }
    [[nodiscard]] log::Stamp knownUntil() const { return m_ingest.knownUntil(); } ///< what came, and what not
    /// How old the newest packet is that was looked at, where others wait; 0 where none do, and of a file.
    [[nodiscard]] log::Duration behind() const { return m_ingest.behind(); }
    /// Of the first packet that was followed, also where the log has dropped it; 0 before there is one.
    [[nodiscard]] log::Stamp firstStamp() const { return m_ingest.firstStamp(); }
    /// What the receiving computer's clock showed: for times of day. All else is by stamps.
    [[nodiscard]] log::WallTime wallOf(log::Stamp stamp) const { return log().timeline().wallOf(stamp); }
    /// For readers on other threads.
    [[nodiscard]] const log::PacketLog& log() const { return m_ingest.log(); }
    /// Nothing where the log has dropped it. The bytes are valid until the session follows the log again.
    [[nodiscard]] std::optional<log::Packet> packet(std::uint64_t number) const {
        return m_ingest.reader().packet(number);
    }
    /// The first packet from a stamp on; end() where there is none. Stamps are taken to grow.
    [[nodiscard]] std::uint64_t packetFrom(log::Stamp stamp) const;
    /// The newest packet that had been received by then; the oldest there is where all came later.
    [[nodiscard]] std::uint64_t packetAt(log::Stamp stamp) const;

    /// Where a stream is `steps` samples after the one at the cursor, or before it: the newest datagram of
    /// that sample; where there are not as many, of the last or the first one. Nothing where it has none.
    [[nodiscard]] std::optional<std::uint64_t> packetOfSample(const log::StreamKey& key, int steps) const;

    // What the operator chose.
    [[nodiscard]] const Cursor& cursor() const { return m_choices.cursor; }
    [[nodiscard]] const Selection& selection() const { return m_choices.selection; }
    [[nodiscard]] const RangeChoice& rangeChoice() const { return m_choices.range; }
    /// The range that was chosen, as it is at the cursor; nothing for all there is.
    [[nodiscard]] std::optional<TimeRange> range() const;
    [[nodiscard]] const std::string& displayFilter() const { return m_choices.displayFilter; }
    /// See Choices.
    [[nodiscard]] const Jump* filterJump() const { return m_choices.filterJump(); }
    [[nodiscard]] const std::string& ownFilter() const { return m_choices.ownFilter(); }
    /// Whether goBack() has somewhere to go.
    [[nodiscard]] bool canGoBack() const { return !m_choices.jumps.empty(); }
    [[nodiscard]] const Annotations& annotations() const { return m_choices.annotations; }
    /// Also where it was hidden before its sender was restarted.
    [[nodiscard]] bool isHidden(const CharacterKey& key) const;
    /// Whether the operator has put it on the floor, likewise.
    [[nodiscard]] bool isLifted(const CharacterKey& key) const;
    [[nodiscard]] const IncidentRequest& incidentRequest() const { return m_choices.incidentRequest; }
    [[nodiscard]] bool isGhostShown() const { return m_choices.isGhostShown; }
    /// When the span that counts for the take began; 0: with the session.
    [[nodiscard]] log::Stamp reset() const { return m_choices.reset; }

    // Characters at the moment.
    /// What is wrong with a character or its sender at the moment, worst first.
    [[nodiscard]] std::vector<const Incident*> troublesOf(const CharacterKey& key) const;

    /// How all do now on the wire, whatever the moment: the one judgement that everything in the window
    /// shows; of a recording in all of it. Valid until the session follows the log again.
    [[nodiscard]] const TakeVerdicts& verdicts() const;
    /// The time that these verdicts are of.
    [[nodiscard]] VerdictSpan verdictSpan() const;
    /// Of one character or who took over from it; of one that is not listed that there is nothing.
    [[nodiscard]] const TakeVerdict& verdict(const CharacterKey& key) const;
    /// What is followed is a file.
    [[nodiscard]] bool isRecording() const { return m_ingest.isFile(); }

    /// A sender that is restarted has another port, and some senders use a port for each kind of message. So
    /// a character of the same host with the same ID that fell silent before this one came is the same one:
    /// what this one has not sent yet is taken from there. Null where there is none, or where both turned out
    /// to send at the same time.
    [[nodiscard]] const Character* predecessor(const CharacterKey& key) const;
    /// True if another sender has taken over by the moment; its character is shown instead of this one.
    [[nodiscard]] bool isSuperseded(const CharacterKey& key) const;
    /// The one that is shown for a character: itself, or the newest that has taken over.
    [[nodiscard]] CharacterKey current(const CharacterKey& key) const;
    /// A character with all that it took over from, oldest first, itself last; empty where there is none.
    [[nodiscard]] std::vector<const Character*> lineage(const CharacterKey& key) const;
    /// Whether two are one character, before and after restarts of its sender.
    [[nodiscard]] bool isSame(const CharacterKey& a, const CharacterKey& b) const;
    /// Whether it is the selected one, before or after a restart.
    [[nodiscard]] bool isSelected(const CharacterKey& key) const {
        return selection().character && isSame(*selection().character, key);
    }
    /// How often its sender was restarted: came from another port, or set its counters back.
    [[nodiscard]] std::uint64_t restartsOf(const CharacterKey& key) const;
    /// Senders of which others have taken over every character.
    [[nodiscard]] std::vector<const Sender*> endedSenders() const;
    /// Whether Session::forget would take it out of the lists.
    [[nodiscard]] bool isForgettable(log::SenderId sender) const { return m_ingest.isForgettable(sender); }
    /// Characters that may be the invention of corrupt headers.
    [[nodiscard]] Unproven unproven() const;
    /// All characters that are to be shown at the moment, in order of first appearance: one that was
    /// restarted stays where it was.
    [[nodiscard]] std::vector<const Character*> currentCharacters() const;
    /// One of these; null for others.
    [[nodiscard]] const Character* findListed(const CharacterKey& key) const;

    /// "Factory", or "Character 1" with its ID where no name was sent, or there is no such character.
    [[nodiscard]] ForeignText displayName(const CharacterKey& key) const;
    [[nodiscard]] Colour colour(const CharacterKey& key) const;
    /// Seconds since the newest datagram of the character, against cursorStamp().
    [[nodiscard]] double ageSeconds(const CharacterKey& key) const;
    /// From the type 12 messages of a character, or of its predecessor where it has sent none itself.
    /// Empty where there is no such character.
    [[nodiscard]] const Metadata& metadata(const CharacterKey& key) const;

    // Messages and poses at the cursor.
    /// The newest complete message of a stream; null where there is none, it cannot be decoded or is too
    /// large (kMostMessageBytes). Valid until
    /// the session follows the log again, or message() of the same stream.
    [[nodiscard]] const Message* message(const CharacterKey& key, std::uint8_t type) const;
    /// Reads the messages of a stream from a stamp up to the cursor, oldest first, at most the newest `most`
    /// of them. Datagrams that cannot be decoded or are one of several of a sample are left out. Returns how
    /// many were visited.
    std::size_t visit(const log::StreamKey& key, log::Stamp fromStamp, std::size_t most,
                      const std::function<void(const Message&)>& visitor) const;
    /// The same with the headers alone, one of each sample, also of those that were sent in several
    /// datagrams.
    std::size_t visitHeaders(const log::StreamKey& key, log::Stamp fromStamp, std::size_t most,
                             const std::function<void(log::Stamp, const wire::Header&)>& visitor) const;
    /// Adds what arrived of a stream in each part, datagram by datagram: finer than its accounting's buckets.
    /// What was lost is left to SettledLosses. Nothing is added where more than `most` datagrams would
    /// have to be looked at. The cursor plays no part.
    void addArrivals(const log::StreamKey& key, const RangeParts& parts, std::size_t most,
                     std::span<RangePart> into) const;
    /// Of the newest datagram of a stream; 0 where there is none.
    [[nodiscard]] log::Stamp newestStamp(const log::StreamKey& key) const;
    /// The newest pose (choosePose, assemble); null without one.
    [[nodiscard]] const CharacterPose* pose(const CharacterKey& key) const;
    /// What is to be said of that pose; nothing without one.
    [[nodiscard]] PoseRemark poseRemark(const CharacterKey& key) const;
    /// The scale message; null where none was received.
    [[nodiscard]] const NullPose* nullPose(const CharacterKey& key) const;
    /// All scale messages of the character itself; null where none was received.
    [[nodiscard]] const NullPoseHistory* nullPoses(const CharacterKey& key) const {
        return m_ingest.nullPoses(key);
    }
    /// What the scale messages of a character are judged by, or those of its predecessor where it has sent
    /// none itself. Valid until the session follows the log again.
    [[nodiscard]] NullPoseEvidence nullPoseEvidence(const CharacterKey& key) const;
    /// Of the null pose; where none was received as measured on poses, else of the reference body. Valid as
    /// message() is.
    [[nodiscard]] const BodyOrigins& bodyOrigins(const CharacterKey& key) const;

    /// What "now" means at the cursor: now() when following, the packet's stamp when paused.
    [[nodiscard]] log::Stamp cursorStamp() const;

protected:
    /// Both outlive this; neither is looked at here.
    SessionView(Ingest& ingest, const Choices& choices);
    void keepVerdicts(); ///< see Session

private:
    /// What was decoded when somebody asked for it, until the cursor has moved on.
    struct Decoded;
    [[nodiscard]] Decoded& decoded() const;

    /// Null if none has taken over by the moment.
    [[nodiscard]] const Character* successor(const Character& character) const;
    [[nodiscard]] std::uint64_t appearance(const Character& character) const;
    [[nodiscard]] bool isIn(const std::set<CharacterKey>& keys, const CharacterKey& key) const;
    [[nodiscard]] bool isPaused() const {
        return m_atNow != this && m_choices.cursor.mode == Cursor::Mode::Paused;
    }
    /// One past the newest packet that the cursor lets through.
    [[nodiscard]] std::uint64_t visibleEnd() const;
    /// The cursor's time where it is paused.
    [[nodiscard]] std::optional<log::Stamp> pausedStamp() const;
    [[nodiscard]] const ForeignText& metadataValue(const CharacterKey& key, std::string_view tag) const;
    [[nodiscard]] std::size_t visibleCount(const log::StreamEntries& entries) const;
    template <class Visitor>
    std::size_t visitFirsts(const log::StreamKey& key, log::Stamp fromStamp, std::size_t most,
                            Visitor&& visitor) const;
    bool readMessage(const log::StreamEntries& entries, std::size_t count, Message& message) const;
    bool readWhole(const log::StreamEntry& entry, Message& message) const;
    [[nodiscard]] const Message* messageOfSample(const CharacterKey& key, std::size_t place,
                                                 std::uint32_t sample) const;

    struct Judged;
    [[nodiscard]] static std::shared_ptr<Judged> newJudged();
    struct Now {};
    SessionView(const SessionView& other, Now);

    Ingest& m_ingest;
    const Choices& m_choices;
    std::unique_ptr<Decoded> m_decoded;
    std::shared_ptr<Judged> m_judged;            ///< the newest verdicts and what they rest on
    std::unique_ptr<const SessionView> m_ownNow; ///< of a view at the cursor
    const SessionView* m_atNow;
};

} // namespace posewire::model
