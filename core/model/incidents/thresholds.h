// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/stream_index.h"
#include "core/log/time.h"
#include "core/model/accounting/stream.h"
#include "core/model/accounting/stream_counts.h"
#include "core/model/accounting/stream_figures.h"
#include "core/model/incidents/incidents.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace posewire::model {

/// A limit of 0 is none.
struct Thresholds {
    double lossPercent = 1;  ///< of the samples expected in the window, incomplete ones included
    double jitterMs = 10;    ///< RFC 3550
    double gapMs = 250;      ///< longest time between samples in the window; at least three usual intervals
    double ageS = 1;         ///< since the newest sample; likewise
    double ratePercent = 20; ///< how far the rate in the window is off what it was before
    double windowS = 5;      ///< the past that counts
    double hysteresis = 0.8; ///< an alert ends below this part of its limit

    friend bool operator==(const Thresholds&, const Thresholds&) = default;
};

struct ThresholdRow {
    double Thresholds::*limit;
    std::string_view key; ///< in settings
    const char* label;    ///< in a form, "&" before its mnemonic
    const char* unit;     ///< as it follows a number
    const char* help;
    double least; ///< that makes sense; 0: the threshold can be switched off
    double most;
    double shownPerUnit = 1;        ///< people see this many times the value
    std::optional<Figure> figure{}; ///< whose limit it is, in the window
    IncidentKind alert{};           ///< where it is exceeded, of a figure
};

/// All thresholds, in the order of forms.
[[nodiscard]] std::span<const ThresholdRow> thresholdTable();

/// How long what is over is mentioned, and how bad a loss is is judged by.
inline constexpr log::Duration kRecentTime = std::chrono::seconds(10);

using LossesByStream = std::unordered_map<log::StreamKey, LossesByCause>;

/// Holds the streams to the thresholds, in the time of the log: one event for each episode.
class ThresholdWatch {
public:
    void set(const Thresholds& thresholds) { m_thresholds = thresholds; }
    [[nodiscard]] const Thresholds& thresholds() const { return m_thresholds; }

    /// A datagram of the stream came: it is looked at until it has been silent for long.
    void wake(Stream& stream);
    /// Forgets the streams of a sender, before they go.
    void retire(log::SenderId sender);
    /// Samples of a stream are lost that should have come by then, beside silences: each loss is held to its
    /// limit by what is of its own cause.
    void takeLoss(const log::StreamKey& stream, LossCause cause, std::uint64_t samples, log::Stamp to);
    /// Looks at the streams that are awake as they were just before a moment.
    void check(log::Stamp stamp, Incidents& incidents);

private:
    struct Loss {
        log::StreamKey stream;
        LossCause cause = LossCause::Unknown;
        std::uint64_t samples = 0;
        log::Stamp to{};
    };
    struct Measure {
        IncidentKind kind;
        double value;
        double limit;
    };
    void check(Stream& stream, log::Stamp stamp, Incidents& incidents) const;
    void noteLosses(log::Stamp stamp, Incidents& incidents) const;
    [[nodiscard]] TimeRange windowBefore(log::Stamp stamp) const;
    bool noteRate(Stream& stream, log::Stamp to, log::Stamp now, Incidents& incidents) const;
    void hold(const Stream& stream, const Measure& measure, log::Stamp stamp, Incidents& incidents) const;

    Thresholds m_thresholds;
    std::vector<Stream*> m_awake;
    std::deque<Loss> m_losses; ///< the newest, oldest first
};

/// Samples that did not come whole, of those that should have come.
struct LossShare {
    std::uint64_t lost = 0;
    std::uint64_t expected = 0;

    LossShare& operator+=(const LossShare& other);
    /// From 0 to 1; 0 if none were expected. By so many deviations more was lost, or less: that of what
    /// comes at random is the root of its count.
    [[nodiscard]] double ratio(double deviations = 0) const;
};

/// The share, from 0 to 1, that each part of a loss is held to its limit by: what its character lost on all
/// its streams there, 0 if that is a few samples; or what it alone lost by more than chance, where that is
/// more: of many streams that lose at random one is always above what all lose together.
[[nodiscard]] std::vector<double>
judgedShares(const Incident& incident, const std::function<LossShare(const Incident::Part&)>& shareOf);

/// What silences that ended in a range of time took of each stream, by cause: it counts at their end, when
/// the next sample came. Of all time where no range is given.
[[nodiscard]] LossesByStream lossesInSilences(const Incidents& incidents,
                                              const std::optional<TimeRange>& range);

} // namespace posewire::model
