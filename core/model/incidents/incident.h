// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/time.h"
#include "core/model/accounting/stream_counts.h"
#include "core/model/keys.h"
#include "core/words/fact.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace posewire::model {

enum class IncidentKind : std::uint8_t {
    SourceUp,
    Loss,
    Local,
    Outage,
    Reordered,
    Duplicates,
    Malformed,
    Foreign,
    Restart,
    Step,
    TimeCode,
    Conflict,
    Scale,
    MetadataChange,
    ScaleChange,
    Overtaken,
    RelayLoop,
    RecordingEnded, ///< by itself: its disk is full, say
    ClockSet,
    LossLimit,
    JitterLimit,
    GapLimit,
    AgeLimit,
    RateLimit,
};
inline constexpr std::size_t kIncidentKinds = 24;

enum class IncidentSeverity : std::uint8_t { Info, Warning, Error };
/// What an operator filters by.
enum class IncidentGroup : std::uint8_t { Sender, Loss, Content, Limit };

/// "source up", "loss" and so on, as people read it.
[[nodiscard]] std::string_view nameOf(IncidentKind kind);
/// Of the contract for scripts: "loss", "outage", "local" …; empty for a note, which is no incident there.
[[nodiscard]] std::string_view wordOf(IncidentKind kind);

[[nodiscard]] words::Fact causeFact(LossCause cause);

/// One thing that happened to one stream, or to a character or sender as a whole.
struct Occurrence {
    IncidentKind kind = IncidentKind::SourceUp;
    log::SenderId sender{}; ///< kNoSender where it is of this computer
    std::optional<std::uint8_t> character{};
    std::optional<std::uint8_t> type{}; ///< of the stream, where it is of one
    log::Stamp from{};
    log::Stamp to{};
    std::uint64_t fromPacket = 0;
    std::uint64_t toPacket = 0;
    std::uint64_t count = 1;
    std::uint64_t samples = 0; ///< lost for good
    double value = 0;          ///< limits: how bad; TimeCode: ms; ClockSet: s; Outage: s
    double limit = 0;          ///< limits: what must not be exceeded
    std::optional<LossCause> cause{};
    words::Fact detail{};
    bool isOver = false; ///< of kinds that last until they are ended: for its stream or character

    /// One at one moment.
    [[nodiscard]] static Occurrence at(IncidentKind kind, log::SenderId sender, log::Stamp stamp,
                                       std::uint64_t packet = 0);
};

/// What belongs together of what went wrong, or changed: of one kind, sender and cause, with all characters
/// and streams that it touched.
struct Incident {
    /// What it was to one stream, or to a character or the sender as a whole.
    struct Part {
        std::optional<std::uint8_t> character{};
        std::optional<std::uint8_t> type{};
        std::uint64_t count = 0;
        std::uint64_t samples = 0;
        log::Stamp from{};
        log::Stamp to{};
        bool isCurrent = true;                ///< of kinds that last until they are ended
        std::optional<log::Stamp> lastMany{}; ///< end of the newest gap of kManySamples or more
        std::uint64_t times = 1;              ///< at which it happened, kApart or more from each other
        bool isAbove = false; ///< of a loss: more than its limit goes on being lost; see judgedShares()
    };
    static constexpr log::Duration kApart = std::chrono::milliseconds(100);
    /// So many missing in a row are seen: that is grave, whatever share of the stream they are.
    static constexpr std::uint64_t kManySamples = 10;
    /// Fewer samples are no share of anything.
    static constexpr std::uint64_t kFewSamples = 3;

    std::uint64_t number = 0; ///< counted from the beginning of the session
    IncidentKind kind = IncidentKind::SourceUp;
    log::SenderId sender{}; ///< kNoSender where it is of this computer
    std::optional<LossCause> cause{};
    log::Stamp firstStamp{};
    log::Stamp lastStamp{};
    std::uint64_t firstPacket = 0;
    std::uint64_t lastPacket = 0;
    std::uint64_t count = 0;   ///< how often it happened
    std::uint64_t times = 1;   ///< at which it did, kApart or more from each other: a burst is one
    std::uint64_t samples = 0; ///< lost for good: Loss, Local, Outage
    double value = 0;          ///< the worst; see Occurrence
    double limit = 0;
    words::Fact detail{};      ///< evidence of the newest loss; of other kinds what happened
    std::vector<Part> parts{}; ///< in the order in which they were touched
    bool isCurrent = true;     ///< lasts, or may
    std::uint64_t version = 0; ///< of the list when it last changed

    [[nodiscard]] IncidentSeverity severity() const;
    [[nodiscard]] IncidentGroup group() const;
    /// Where it is of one alone.
    [[nodiscard]] std::optional<std::uint8_t> character() const;
    [[nodiscard]] std::optional<std::uint8_t> type() const;
    /// Each once, in growing order.
    [[nodiscard]] std::vector<std::uint8_t> characters() const;
    [[nodiscard]] std::vector<std::uint8_t> types() const;
    /// All of it is of types that are sent again and again: what is missing are parts of messages.
    [[nodiscard]] bool isOfMessages() const;
    /// What of it was to one character, or to some; as a whole where it is of no character.
    [[nodiscard]] Incident of(std::uint8_t character) const { return of(std::span(&character, 1)); }
    [[nodiscard]] Incident of(std::span<const std::uint8_t> characters) const;
    /// Whether a character is touched, or all of its sender; of what lasts, whether it still is.
    [[nodiscard]] bool concerns(std::uint8_t character) const;
    [[nodiscard]] bool concerns(std::uint8_t character, std::uint8_t type) const;
    /// What of it was to one stream.
    [[nodiscard]] Incident of(const Part& part) const;
    /// What happened, without who and when.
    [[nodiscard]] words::Fact fact() const;
    /// What happened to one stream: a silence is what it lost.
    [[nodiscard]] words::Fact fact(const Part& part) const;
};

} // namespace posewire::model
