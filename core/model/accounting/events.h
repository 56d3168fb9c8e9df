// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/accounting/stream_counts.h"
#include "core/model/keys.h"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace posewire::model {

enum class EventKind : std::uint8_t {
    SenderUp,
    SenderDown,
    Gap,
    Burst,
    Restart,
    Malformed,
    Foreign,
    Dropped,
    MetadataChange,
    ScaleChange,
    TimeCodeJump,
    CharacterConflict,
    Stale,
    Overtaken,
    RelayLoop,
    ClockSet,
    LossLimit,
    JitterLimit,
    GapLimit,
    AgeLimit,
    RateLimit,
};
inline constexpr std::size_t kEventKinds = 21;

enum class EventSeverity : std::uint8_t { Info, Warning, Error };

enum class EventGroup : std::uint8_t { Sender, Loss, Content, Limit };

/// "source up", "gap" and so on.
[[nodiscard]] std::string_view nameOf(EventKind kind);

/// Something that happened or lasts: one for an episode, however often it happens in it.
struct Event {
    std::uint64_t number = 0; ///< counted from the beginning of the session
    EventKind kind = EventKind::SenderUp;
    log::SenderId sender{}; ///< kNoSender where it is of this computer
    std::optional<std::uint8_t> character{};
    std::optional<std::uint8_t> type{}; ///< of the stream, where it is of one
    log::Stamp firstStamp{};
    log::Stamp lastStamp{};
    std::uint64_t firstPacket = 0;
    std::uint64_t lastPacket = 0;
    std::uint64_t count = 1;   ///< how often it happened
    std::uint64_t samples = 0; ///< Gap, Burst: lost; Dropped, Overtaken: datagrams
    double value = 0;          ///< limits: the worst; TimeCodeJump: ms; ClockSet: s
    double limit = 0;          ///< limits: what must not be exceeded
    std::optional<LossCause> cause{};
    std::string
        detail{}; ///< content: what changed; RelayLoop: all of it; Gap and Burst: evidence of the newest
    bool isCurrent = true; ///< lasts, or may

    /// One that happened once, at one moment.
    [[nodiscard]] static Event of(EventKind kind, log::SenderId sender, log::Stamp stamp,
                                  std::uint64_t packet = 0);
    [[nodiscard]] EventSeverity severity() const;
    [[nodiscard]] EventGroup group() const;
    /// One line, without who and when.
    [[nodiscard]] std::string text() const;
};

/// How a character does, for all who show it.
struct Condition {
    /// Seconds of silence that are a warning, and those that are an error, also before an event reports it.
    static constexpr double kSilentS = 0.25;
    static constexpr double kStaleS = 1.0;

    enum class Level : std::uint8_t { Good, Warning, Error };
    Level level = Level::Good;
    std::string reason; ///< one line; empty where it is good
    /// What it rests on where that is an event: its number. Else silence or a contradiction.
    std::optional<std::uint64_t> event{};
};

/// The events of a session. Bounded: the oldest that have ended go first, and details are clipped.
class Events {
public:
    static constexpr std::size_t kMost = 10'000;
    static constexpr std::size_t kMostDetailBytes = 1'024;
    /// What happens again within this time is of the same episode.
    static constexpr log::Duration kQuiet = std::chrono::seconds(5);

    /// Oldest first.
    [[nodiscard]] const std::deque<Event>& all() const { return m_events; }
    /// Grows whenever an event comes or changes.
    [[nodiscard]] std::uint64_t version() const { return m_version; }

    /// Those that last, in the order in which they began.
    [[nodiscard]] std::vector<const Event*> current() const;
    /// Those of one sender that last, in any order.
    [[nodiscard]] std::vector<const Event*> currentOf(log::SenderId sender) const;
    /// Those that lasted at a time in the past, in the same order, with all that is known of them now.
    [[nodiscard]] std::vector<const Event*> currentAt(log::Stamp stamp) const;
    [[nodiscard]] std::size_t memoryBytes() const;
    /// Null where there is none of that number, or none any more.
    [[nodiscard]] const Event* find(std::uint64_t number) const;

    /// Something happened: a new event, or once more in an episode that lasts (same kind, sender, character,
    /// type and cause).
    void report(Event event);
    /// An episode is over.
    void end(const Event& like, log::Stamp stamp);
    [[nodiscard]] bool isCurrent(const Event& like) const { return findCurrent(like).has_value(); }
    /// Nothing of a sender lasts any longer.
    void retire(log::SenderId sender);
    /// Ends what has been quiet for long, by the time of the log.
    void advance(log::Stamp stamp);

private:
    /// What makes two events one episode; those of a sender are next to each other.
    struct Episode {
        log::SenderId sender{};
        EventKind kind{};
        std::optional<std::uint8_t> character{};
        std::optional<std::uint8_t> type{};
        std::optional<LossCause> cause{};

        friend auto operator<=>(const Episode&, const Episode&) = default;
    };
    [[nodiscard]] static Episode episodeOf(const Event& event);
    [[nodiscard]] std::optional<std::size_t> findCurrent(const Event& like) const;
    [[nodiscard]] const Event& at(std::uint64_t number) const { return m_events[indexOf(number)]; }
    [[nodiscard]] std::size_t indexOf(std::uint64_t number) const;
    void forget();

    std::deque<Event> m_events;
    std::map<Episode, std::uint64_t> m_current; ///< numbers of those that last
    std::uint64_t m_next = 0;
    std::uint64_t m_version = 0;
};

} // namespace posewire::model
