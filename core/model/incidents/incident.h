// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/stream_index.h"
#include "core/log/time.h"
#include "core/model/accounting/stream_counts.h"
#include "core/model/incidents/content_fault.h"
#include "core/model/keys.h"
#include "core/words/fact.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
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
    Content,
    Scale,
    MetadataChange,
    ScaleChange,
    Overtaken,
    RelayLoop,
    RecordingEnded, ///< by itself: its disk is full, say; or in another file, as its own is gone
    ProbeSilent,    ///< nothing is heard of it any more
    ClockSet,
    Fragments, ///< do not get here
    LossLimit,
    JitterLimit,
    GapLimit,
    AgeLimit,
    RateLimit,
};
inline constexpr std::size_t kIncidentKinds = 27;

enum class IncidentSeverity : std::uint8_t { Info, Warning, Error };
enum class IncidentGroup : std::uint8_t { Sender, Loss, Content, Limit };

/// "source up", "loss" and so on, as people read it.
[[nodiscard]] std::string_view nameOf(IncidentKind kind);

[[nodiscard]] words::Fact causeFact(LossCause cause);

/// One thing that happened to one stream, or to a character or sender as a whole.
struct Occurrence {
    IncidentKind kind = IncidentKind::SourceUp;
    ContentFault what = ContentFault::None; ///< of Content
    log::SenderId sender{};                 ///< kNoSender where it is of this computer
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
        log::SenderId sender{};
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

        /// Nothing if it is of the sender as a whole.
        [[nodiscard]] std::optional<CharacterKey> whose() const {
            return character ? std::optional(CharacterKey{sender, *character}) : std::nullopt;
        }
        [[nodiscard]] bool isSampled() const { return !type || countsSamples(*type); }
    };
    static constexpr log::Duration kApart = std::chrono::milliseconds(100);
    /// So many missing in a row are seen: that is grave, whatever share of the stream they are.
    static constexpr std::uint64_t kManySamples = 10;
    /// Fewer samples are no share of anything.
    static constexpr std::uint64_t kFewSamples = 3;

    std::uint64_t number = 0; ///< counted from the beginning of the session
    IncidentKind kind = IncidentKind::SourceUp;
    ContentFault what = ContentFault::None; ///< of Content
    log::SenderId sender{};                 ///< kNoSender if it is of this computer, or of several
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
    /// Until it is ended, else until it has been quiet.
    [[nodiscard]] bool lasts() const;
    /// Nothing unless it is of one alone.
    [[nodiscard]] std::optional<CharacterKey> character() const;
    [[nodiscard]] std::optional<std::uint8_t> type() const;
    /// Each once, in growing order.
    [[nodiscard]] std::vector<CharacterKey> characters() const;
    [[nodiscard]] std::vector<std::uint8_t> types() const;
    /// All of it is of types that are sent again and again: what is missing are parts of messages.
    [[nodiscard]] bool isOfMessages() const;
    /// Samples alone where both samples and messages were lost: a message is no sample.
    [[nodiscard]] std::uint64_t lost() const;
    /// What of it was to one character, or to some; as a whole where it is of no character.
    [[nodiscard]] Incident of(const CharacterKey& character) const { return of(std::span(&character, 1)); }
    [[nodiscard]] Incident of(std::span<const CharacterKey> characters) const;
    /// Without the parts of which a function says so, and what it counts of them.
    [[nodiscard]] Incident without(const std::function<bool(const Part&)>& isLeftOut) const;
    /// Calls f(sender, samples) with what each sender lost.
    template <class Function>
    void forEachShare(Function&& f) const {
        if (sender != log::kNoSender) {
            f(sender, samples);
            return;
        }
        for (const Part& part : parts) {
            f(part.sender, part.samples);
        }
    }
    /// Whether a character is touched, or all of its sender; of what lasts, whether it still is.
    [[nodiscard]] bool concerns(const CharacterKey& character) const;
    [[nodiscard]] bool concerns(const log::StreamKey& stream) const;
    [[nodiscard]] Incident of(const Part& part) const;
    [[nodiscard]] words::Fact fact() const;
    /// What happened to one stream: a silence is what it lost.
    [[nodiscard]] words::Fact fact(const Part& part) const;
};

/// "37 samples lost", or "2.3 % lost" of the samples expected if that says more; 0 expected: not known.
[[nodiscard]] words::Fact lostFact(const Incident& incident, std::uint64_t samples, std::uint64_t expected);

/// A kind of incident: a row of the table below.
struct IncidentKindFacts {
    IncidentKind kind;
    std::string_view name;
    std::string_view word; ///< of the contract for scripts; empty for a note, which is no incident there
    words::Kind says;      ///< Nothing if its detail says it
    IncidentSeverity severity;
    IncidentGroup group;
    bool lasts = false;         ///< until it is ended, else until it has been quiet
    bool isOfCharacter = false; ///< one for each character, else one for all of its sender
    bool sumsValue = false;     ///< else the worst value counts
    int decimals = 0;           ///< of the value, as it is said
};

inline constexpr std::array<IncidentKindFacts, kIncidentKinds> kIncidentKindTable = [] {
    using K = IncidentKind;
    using S = IncidentSeverity;
    using G = IncidentGroup;
    using W = words::Kind;
    return std::array<IncidentKindFacts, kIncidentKinds>{{
        {K::SourceUp, "source up", "", W::SenderStarted, S::Info, G::Sender},
        {K::Loss, "loss", "loss", W::Loss, S::Warning, G::Loss},
        {K::Local, "lost here", "local", W::LostHere, S::Error, G::Loss, false, false, true},
        {K::Outage, "outage", "outage", W::Outage, S::Warning, G::Sender, true},
        {K::Reordered, "reordered", "reordered", W::Reordered, S::Warning, G::Loss},
        {K::Duplicates, "duplicates", "duplicates", W::Duplicated, S::Warning, G::Loss},
        {K::Malformed, "malformed", "malformed", W::Malformed, S::Warning, G::Content},
        {K::Foreign, "foreign", "foreign", W::NotMxtp, S::Warning, G::Content},
        {K::Restart, "restart", "restart", W::Restarted, S::Warning, G::Sender},
        {K::Step, "rate changed", "step", W::Nothing, S::Warning, G::Sender},
        {K::TimeCode, "time code", "clock", W::Nothing, S::Warning, G::Content},
        {K::Conflict, "two senders", "conflict", W::Nothing, S::Error, G::Sender, false, true},
        {K::Content, "content", "content", W::Nothing, S::Warning, G::Content, true, true},
        {K::Scale, "contradiction", "scale", W::Nothing, S::Warning, G::Content, true, true},
        {K::MetadataChange, "metadata change", "", W::Nothing, S::Info, G::Content, false, true},
        {K::ScaleChange, "scale change", "", W::NullPoseChanged, S::Info, G::Content, false, true},
        {K::Overtaken, "overtaken", "local", W::Overtaken, S::Error, G::Loss, false, false, true},
        {K::RelayLoop, "relay loop", "local", W::Nothing, S::Error, G::Sender},
        {K::RecordingEnded, "recording", "local", W::Nothing, S::Error, G::Sender},
        {K::ProbeSilent, "probe", "transport", W::Nothing, S::Error, G::Sender},
        {K::ClockSet, "clock set", "clock", W::ClockSet, S::Warning, G::Sender},
        {K::Fragments, "fragments", "loss", W::Nothing, S::Error, G::Loss, true},
        {K::LossLimit, "loss limit", "limit", W::LossLimit, S::Warning, G::Limit, true, false, false, 2},
        {K::JitterLimit, "jitter limit", "limit", W::JitterLimit, S::Warning, G::Limit, true, false, false,
         1},
        {K::GapLimit, "gap limit", "limit", W::GapLimit, S::Warning, G::Limit, true},
        {K::AgeLimit, "age limit", "limit", W::AgeLimit, S::Error, G::Limit, true, false, false, 1},
        {K::RateLimit, "rate limit", "limit", W::RateLimit, S::Warning, G::Limit, true, false, false, 1},
    }};
}();

// Each once, in the order of the enum.
static_assert(std::ranges::adjacent_find(kIncidentKindTable, std::ranges::greater_equal(),
                                         &IncidentKindFacts::kind) == kIncidentKindTable.end());

inline const IncidentKindFacts& factsOf(IncidentKind kind) {
    return kIncidentKindTable[static_cast<std::size_t>(kind)];
}

} // namespace posewire::model
