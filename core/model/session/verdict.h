// SPDX-License-Identifier: MIT
#pragma once

#include "core/model/incidents/thresholds.h"
#include "core/model/session/listed_incidents.h"
#include "core/model/session/roster.h"

#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

/// Whether it is good: in the window, the report and the JSON the same answer.
namespace posewire::model {

/// The answer to: is it good, and if not, whose fault, and is it over?
struct TakeVerdict {
    enum class State : std::uint8_t { None, Good, Warning, Bad };
    State state = State::None;
    words::Fact said{words::Kind::NoDataYet}; ///< the answer, and the worst reason for it
    log::Stamp since{}; ///< when what it says began; of Good when the last incident was over; of None 0
    std::optional<std::uint64_t> incident{}; ///< that it rests on
    std::optional<CharacterKey> character{}; ///< that it is about, if it is one
    bool isOver = false;                     ///< the reason is over, and mentioned only because it is recent

    friend bool operator==(const TakeVerdict&, const TakeVerdict&) = default;
};
/// Whether both say the same, but for numbers that grow and a time that passes.
[[nodiscard]] bool sayTheSame(const TakeVerdict& one, const TakeVerdict& other);
/// "none", "good", "warning", "bad".
[[nodiscard]] std::string_view nameOf(TakeVerdict::State state);

/// What counts: incidents that have ended before it are forgotten, those that began after it are not known.
/// Of one that is closed only what was in it counts, as if it were a recording of its own.
struct VerdictSpan {
    /// Live, an incident that is over is mentioned for as long.
    static constexpr log::Duration kRecent = kRecentTime;
    log::Stamp from = log::Stamp::min();
    log::Stamp to = log::Stamp::max();

    [[nodiscard]] bool isClosed() const { return to != log::Stamp::max(); }
};
/// The last moments of what is on the wire, but nothing before the reset.
[[nodiscard]] VerdictSpan recentSpan(const SessionView& session);

/// Returns the part of a range that is known; all there is without a range.
[[nodiscard]] VerdictSpan spanOf(const SessionView& session, const std::optional<TimeRange>& range);

struct TakeVerdicts {
    TakeVerdict all;
    std::map<CharacterKey, TakeVerdict> characters;
};
[[nodiscard]] TakeVerdicts verdictsOf(const SessionView& session, const VerdictSpan& span,
                                      const std::vector<const Character*>& characters);

/// Of all, or of one character and its sender, through restarts of the sender.
[[nodiscard]] TakeVerdict verdictOf(const SessionView& session, const VerdictSpan& span,
                                    std::optional<CharacterKey> character = {});

class Verdicts {
public:
    /// Of the first moment of a session. The view outlives this.
    Verdicts(const SessionView& session, const Moment& moment);
    /// Of another moment of the same session, with the same verdicts.
    Verdicts(const SessionView& session, const Moment& moment, const Verdicts& same);

    /// In the time of the log; with conditions that last.
    [[nodiscard]] const Incidents& incidents() const;
    [[nodiscard]] const Thresholds& thresholds() const;
    /// What is wrong with a character or its sender at the moment, worst first.
    [[nodiscard]] std::vector<const Incident*> troublesOf(const CharacterKey& key) const;
    /// What the incident will be called that a sender's pending gaps may become.
    [[nodiscard]] std::uint64_t provisionalNumber(log::SenderId sender) const;

    /// How all do now on the wire, whatever the moment: the one judgement that everything in the window
    /// shows; of a recording in all of it. Valid until the session follows the log again.
    [[nodiscard]] const TakeVerdicts& all() const;
    /// Of one character or the one that took over from it; of one that is not listed that there is nothing.
    [[nodiscard]] const TakeVerdict& of(const CharacterKey& key) const;
    /// The time that these verdicts are of.
    [[nodiscard]] VerdictSpan span() const;
    void keep() const; ///< see Session::judge

private:
    struct Judged;
    const SessionView& m_session;
    Moment m_moment;
    std::shared_ptr<Judged> m_judged;
};

} // namespace posewire::model
