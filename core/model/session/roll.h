// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/log/sender_table.h"
#include "core/log/stream_index.h"
#include "core/model/accounting/packet_digest.h"
#include "core/model/accounting/stream.h"
#include "core/model/accounting/stream_figures.h"
#include "core/model/foreign_text.h"
#include "core/model/keyed_list.h"
#include "core/model/session/sender.h"
#include "core/model/session/unconfirmed.h"
#include "core/wire/codec.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <list>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace posewire::model {

/// A packet on its way through the stages of an ingest, with what each found out for those after it.
struct Observed {
    const log::Packet& packet;
    std::optional<wire::Header> header{};     ///< nothing if it cannot be read
    const wire::Datagram* datagram = nullptr; ///< null if it cannot be decoded
    PacketDigest digest{};
    Sender* sender = nullptr; ///< null if the log does not know it
    Stream* stream = nullptr;
    Character* character = nullptr;
};

/// Sums over senders.
struct SenderTotals {
    std::uint64_t senders = 0;
    std::uint64_t datagrams = 0;
    std::uint64_t bytes = 0;
    std::uint64_t malformed = 0;
    std::uint64_t foreign = 0;
    std::uint64_t skippedBytes = 0;
    std::uint64_t kernelDrops = 0;
    bool hasUncountedDrops = false; ///< of one of them

    void add(const Sender& sender);
    void add(const log::Packet& packet, PacketKind kind);
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

/// The names of a sender that was retired.
struct FormerSender {
    log::SenderId id{};
    std::string address;
    std::vector<std::pair<std::uint8_t, ForeignText>> names; ///< by character, of those that had one
};

/// Learns what becomes of the rows of a Roll.
class RollListener {
public:
    virtual void began(Stream& stream, const Sender& sender) = 0;
    virtual void tookOver(const CharacterKey& before, const CharacterKey& after, log::Stamp since) = 0;
    /// The character that took over from this one is gone: it is expected to send again.
    virtual void isAwaited(const CharacterKey& key) = 0;
    /// Called before its rows are removed.
    virtual void goes(const Sender& sender) = 0;
    virtual void haveGone() = 0;

protected:
    ~RollListener() = default;
};

/// The first stage: senders, characters and streams in order of first appearance, and which character goes on
/// under another port or ID. If there are too many, the sender that has been silent longest is retired with
/// all of its rows and remembered in sums; a sender of nothing but strange bytes takes no place that a
/// performance could need.
class Roll {
public:
    static constexpr std::size_t kMostSenders = 512;
    static constexpr std::size_t kMostStrangers = 128; ///< senders of nothing that could be decoded
    static constexpr std::size_t kMostCharacters = 1024;
    static constexpr std::size_t kMostStreams = log::StreamIndex::kStreamLimit;
    /// A sender with more streams than these is no performance.
    static constexpr std::size_t kMostStreamsOfSender = 1024;
    static constexpr std::size_t kBucketsOfSender = 256;
    /// Retired senders that incidents can still name, the newest, and characters of each.
    static constexpr std::size_t kMostFormer = 256;
    static constexpr std::size_t kMostFormerNames = 32;
    static constexpr log::Duration kForgettable = std::chrono::seconds(1);

    /// Both outlive this.
    Roll(const log::SenderTable& known, RollListener& listener) : m_known(known), m_listener(listener) {}

    /// Declared of all senders that come from now on.
    void setUsual(const SenderOverride& usual) { m_usual = usual; }
    /// Makes counts of this range exact for packets that follow; Ingest::cutAt() does so for earlier ones.
    void setEdges(const TimeRange& range);
    [[nodiscard]] const TimeRange& edges() const { return m_edges; }

    [[nodiscard]] const KeyedList<log::SenderId, Sender>& senders() const { return m_senders; }
    [[nodiscard]] const KeyedList<CharacterKey, Character>& characters() const { return m_characters; }
    [[nodiscard]] const KeyedList<log::StreamKey, Stream>& streams() const { return m_streams; }
    /// The rows, to be changed.
    [[nodiscard]] KeyedList<log::SenderId, Sender>& senders() { return m_senders; }
    [[nodiscard]] KeyedList<CharacterKey, Character>& characters() { return m_characters; }
    [[nodiscard]] KeyedList<log::StreamKey, Stream>& streams() { return m_streams; }

    /// Finds the sender of a packet, or adds it. Null if the log does not know it.
    Sender* take(const log::Packet& packet);
    /// Finds the character and the stream of a datagram that was decoded, or adds them. False if there are
    /// too many already.
    bool enter(Observed& seen);
    /// Looks whether a character is a performer of the same sender who has been given another ID, for as long
    /// as that may turn out.
    void findRenumbered(const Observed& seen);

    [[nodiscard]] const RetiredTotals& retired() const { return m_retired; }
    /// Null unless it is one of the newest.
    [[nodiscard]] const FormerSender* former(log::SenderId id) const;
    /// Whether nothing more is expected of a sender: others have taken over its characters, or it has been
    /// silent for kForgettable.
    [[nodiscard]] bool isForgettable(log::SenderId sender, log::Stamp now) const;
    /// Retires such a sender. False, and nothing happens, for others.
    bool forget(log::SenderId sender, log::Stamp now);
    [[nodiscard]] bool hasEnded(const Sender& sender) const;

private:
    using Recency = std::list<log::SenderId>; ///< longest silent first
    struct Place {
        Recency* list;
        Recency::iterator at;
    };

    // Null if there are too many already.
    Character* characterOf(Sender& sender, const Observed& seen);
    Stream* streamOf(const log::StreamKey& key, const Sender& sender);
    [[nodiscard]] Character* predecessorOf(const Character& character);
    void takeOver(Character& before, Character& after, log::Stamp since);
    /// Null unless it has taken over.
    [[nodiscard]] const Character* heirOf(const Character& character) const;

    void promote(const Sender& sender);
    bool retireSilent();
    void retireOldest(const Recency& recency, std::size_t count);
    void retire(const std::unordered_set<log::SenderId>& going);
    void remember(const Sender& sender);
    void bequeath(const Character& character);
    void forgetHostOf(const Sender& sender);

    const log::SenderTable& m_known;
    RollListener& m_listener;
    SenderOverride m_usual;
    TimeRange m_edges{log::Stamp::min(), log::Stamp::max()};
    KeyedList<log::SenderId, Sender> m_senders;
    KeyedList<CharacterKey, Character> m_characters;
    KeyedList<log::StreamKey, Stream> m_streams;
    log::Stamp m_observed{}; ///< of the newest packet
    Recency m_performers;    ///< have sent a few datagrams at least
    Recency m_newcomers;     ///< have sent one that could be decoded
    Recency m_strangers;     ///< have not
    std::unordered_map<log::SenderId, Place> m_recencies;
    std::unordered_map<log::SenderId, std::uint64_t> m_passersBy; ///< datagrams of retired senders
    std::unordered_map<std::string, log::SenderId> m_newestOfHost;
    std::map<std::pair<std::string, std::uint8_t>, std::deque<CharacterKey>> m_namesakes; ///< by host and ID
    std::size_t m_characterCount = 0; ///< that there ever were
    RetiredTotals m_retired;
    std::deque<FormerSender> m_former; ///< oldest first
    Unconfirmed m_unconfirmed;
};

} // namespace posewire::model
