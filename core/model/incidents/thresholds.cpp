// SPDX-License-Identifier: MIT
#include "core/model/incidents/thresholds.h"

#include "core/model/accounting/attribution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace posewire::model {
namespace {

constexpr double kMost = 100'000;
constexpr double kPercent = 100;
/// So many intervals between samples are no gap, however slow a stream is.
constexpr double kSlow = 3;
/// What has been silent for longer is looked at again when something comes.
constexpr double kAsleepS = 10;
/// What is missing may still come until then, and whose loss it was is known.
constexpr log::Duration kSettling = Attribution::kPatience + std::chrono::milliseconds(50);

using T = Thresholds;

constexpr std::array kRows{
    ThresholdRow{&T::lossPercent, "lossPercent", "&Loss above", " %",
                 "Of the samples that should have come; incomplete ones included", 0, kMost, 1,
                 Figure::LossShare, IncidentKind::LossLimit},
    ThresholdRow{&T::jitterMs, "jitterMs", "&Jitter above", " ms", "As RFC 3550 computes it", 0, kMost, 1,
                 Figure::Jitter, IncidentKind::JitterLimit},
    ThresholdRow{&T::gapMs, "gapMs", "&Gap above", " ms", "Longest time between two samples", 0, kMost, 1,
                 Figure::SpacingMost, IncidentKind::GapLimit},
    ThresholdRow{&T::ageS, "ageS", "&Age above", " s", "Since the newest sample", 0, kMost},
    ThresholdRow{&T::ratePercent, "ratePercent", "&Rate off by more than", " %",
                 "How far the rate is from what was usual", 0, kMost},
    ThresholdRow{&T::windowS, "windowS", "&Over the last", " s",
                 "The past that loss, gap and rate are taken from", 1, 60},
    ThresholdRow{&T::hysteresis, "hysteresis", "Alert ends &below", " % of its limit",
                 "So that a figure that hovers about its limit alerts once", 1 / kPercent, 1, kPercent},
};

/// Of a stream in a window, without what silences took, and what is of another cause. What has just begun
/// would have brought as much in all of it: a few samples of its first second are no share of anything.
LossShare shareIn(const Stream& stream, const TimeRange& window, LossCause cause,
                  const LossesByStream& silent, const LossesByStream& known) {
    const StreamCounts counts = stream.accounting.countsBetween(window.from, window.to);
    const std::uint64_t lost = counts.lost + counts.incomplete;
    const auto sumOf = [&stream](const LossesByStream& losses) {
        const auto own = losses.find(stream.key);
        return own == losses.end() ? LossesByCause() : own->second;
    };
    const LossesByCause inSilence = sumOf(silent);
    const LossesByCause byCause = sumOf(known);
    const std::uint64_t others = std::accumulate(inSilence.begin(), inSilence.end(), std::uint64_t{0}) +
                                 std::accumulate(byCause.begin(), byCause.end(), std::uint64_t{0}) -
                                 byCause[static_cast<std::size_t>(cause)];
    const double age = log::secondsOf(window.to - stream.accounting.firstStamp());
    const double more = age > 0 ? std::max(1.0, window.seconds() / age) : 1;
    return {lost - std::min(lost, others),
            static_cast<std::uint64_t>(more * static_cast<double>(counts.expected()))};
}

/// Of a time between samples; a limit of 0 is none.
double slackened(double limit, double intervals) {
    return limit > 0 ? std::max(limit, kSlow * intervals) : limit;
}

} // namespace

std::span<const ThresholdRow> thresholdTable() {
    return kRows;
}

void ThresholdWatch::wake(Stream& stream) {
    if (!stream.isWatched && countsSamples(stream.key.type)) {
        stream.isWatched = true;
        m_awake.push_back(&stream);
    }
}

void ThresholdWatch::retire(log::SenderId sender) {
    std::erase_if(m_awake, [sender](const Stream* stream) { return stream->key.sender == sender; });
}

void ThresholdWatch::takeLoss(const log::StreamKey& stream, LossCause cause, std::uint64_t samples,
                              log::Stamp to) {
    constexpr std::size_t kMostKept = 16'384;
    const log::Stamp oldest = to - std::max(log::durationOf(m_thresholds.windowS), kRecentTime);
    while (!m_losses.empty() && (m_losses.front().to < oldest || m_losses.size() >= kMostKept)) {
        m_losses.pop_front();
    }
    m_losses.push_back({stream, cause, samples, to});
}

void ThresholdWatch::noteLosses(log::Stamp stamp, Incidents& incidents) const {
    std::vector<const Incident*> losses = incidents.current();
    std::erase_if(losses, [](const Incident* one) { return one->kind != IncidentKind::Loss; });
    if (losses.empty()) {
        return;
    }
    std::unordered_map<log::StreamKey, const Stream*> awake;
    for (const Stream* stream : m_awake) {
        awake[stream->key] = stream;
    }
    const auto sharesIn = [&](const TimeRange& range) {
        LossesByStream known;
        for (const Loss& one : m_losses) {
            if (one.to >= range.from && one.to < range.to) {
                known[one.stream][static_cast<std::size_t>(one.cause)] += one.samples;
            }
        }
        return [&, range, known = std::move(known),
                silent = lossesInSilences(incidents, range)](const Incident& loss) {
            return judgedShares(loss, [&](const Incident::Part& part) {
                const auto stream =
                    awake.find({loss.sender, part.character.value_or(0), part.type.value_or(0)});
                return stream == awake.end()
                           ? LossShare()
                           : shareIn(*stream->second, range, loss.cause.value_or(LossCause::Unknown), silent,
                                     known);
            });
        };
    };
    const TimeRange window = windowBefore(stamp);
    const auto inWindow = sharesIn(window);
    const auto recently = sharesIn({window.to - kRecentTime, window.to});
    for (const Incident* loss : losses) {
        incidents.noteShares(loss->number, inWindow(*loss), recently(*loss), m_thresholds.lossPercent,
                             m_thresholds.hysteresis);
    }
}

TimeRange ThresholdWatch::windowBefore(log::Stamp stamp) const {
    const log::Stamp to = stamp - kSettling;
    return {to - log::durationOf(m_thresholds.windowS), to};
}

void ThresholdWatch::check(log::Stamp stamp, Incidents& incidents) {
    noteLosses(stamp, incidents);
    std::erase_if(m_awake, [&](Stream* stream) {
        check(*stream, stamp, incidents);
        const double ageS = log::secondsOf(stamp - stream->accounting.lastStamp());
        stream->isWatched = ageS <= std::max({kAsleepS, m_thresholds.windowS, m_thresholds.ageS});
        return !stream->isWatched;
    });
}

void ThresholdWatch::check(Stream& stream, log::Stamp stamp, Incidents& incidents) const {
    const StreamAccounting& accounting = stream.accounting;
    const TimeRange window = windowBefore(stamp);
    const double ageS = log::secondsOf(stamp - accounting.lastStamp());
    const RangeFigures read = countedFigures(accounting, window);
    const double meanMs = std::fmax(0, rowOf(Figure::SpacingMean).read(read)); // 0 if it is not known
    const double intervalS = stream.usualHz > 0 ? 1 / stream.usualHz : meanMs / 1000;
    if (stream.isEstablished()) {
        hold(stream, {IncidentKind::AgeLimit, ageS, slackened(m_thresholds.ageS, intervalS)}, stamp,
             incidents);
    }
    if (read.counts.samples == 0) {
        return;
    }
    for (const ThresholdRow& row : kRows) {
        if (row.figure) {
            const double value = std::fmax(0, rowOf(*row.figure).read(read)); // 0 if it is not known
            const double limit = m_thresholds.*row.limit;
            const bool isGap = row.alert == IncidentKind::GapLimit;
            hold(stream, {row.alert, value, isGap ? slackened(limit, 1000 * intervalS) : limit}, stamp,
                 incidents);
        }
    }
    // While an incident explains it, it says nothing of what is usual.
    if (stamp <= stream.excusedUntil || m_thresholds.windowS <= 0) {
        return;
    }
    const bool isWholeWindow = accounting.firstStamp() <= window.from && ageS < m_thresholds.windowS / 2;
    if (!isWholeWindow || noteRate(stream, window.to, stamp, incidents)) {
        return;
    }
    const double rateHz = static_cast<double>(read.counts.samples) / m_thresholds.windowS;
    double& usualHz = stream.usualHz;
    if (usualHz > 0) {
        const double off = std::abs(rateHz - usualHz);
        // By how many samples a clean window may differ from what is usual: its ends cut one off each; if the
        // step is irregular, three standard deviations of what comes at random.
        const double chance = accounting.step() != 0 ? 2 : 3 * std::sqrt(usualHz * m_thresholds.windowS);
        const double offPercent = off * m_thresholds.windowS > chance ? 100 * off / usualHz : 0;
        hold(stream, {IncidentKind::RateLimit, offPercent, m_thresholds.ratePercent}, stamp, incidents);
    }
    // What lasts becomes usual: half of the way in about a minute of two checks a second.
    constexpr double kShare = 1.0 / 180;
    usualHz += usualHz > 0 ? (rateHz - usualHz) * kShare : rateHz;
}

/// Whether the sender sends at another rate than before, what it lost included, or may: it does where the
/// rate is the same in two short times one after the other. Of an irregular stream that is not known.
bool ThresholdWatch::noteRate(Stream& stream, log::Stamp to, log::Stamp now, Incidents& incidents) const {
    constexpr double kLeastS = 0.5;
    constexpr double kLeastSamples = 20;
    constexpr double kSteadyPercent = 10;
    const double usualHz = stream.accounting.step() != 0 ? stream.usualHz : 0;
    const double spanS = usualHz > 0 ? std::max(kLeastS, std::ceil(10 * kLeastSamples / usualHz) / 10) : 0;
    if (usualHz <= 0 || m_thresholds.ratePercent <= 0 || 2 * spanS > m_thresholds.windowS) {
        return false;
    }
    const log::Duration span = log::durationOf(spanS);
    const auto rateFrom = [&](log::Stamp from) {
        return static_cast<double>(stream.accounting.countsBetween(from, from + span).expected()) / spanS;
    };
    const auto isOff = [](double rate, double from, double percent) {
        return 100 * std::abs(rate - from) > percent * from;
    };
    const double before = rateFrom(to - 2 * span);
    const double rateHz = rateFrom(to - span);
    const bool isNew = rateHz > 0 && isOff(rateHz, usualHz, m_thresholds.ratePercent);
    if (!isNew || !isOff(before, usualHz, m_thresholds.ratePercent) ||
        isOff(before, rateHz, kSteadyPercent)) {
        return isNew && !isOff(before, usualHz, m_thresholds.ratePercent);
    }
    Occurrence one = Occurrence::at(IncidentKind::Step, stream.key.sender, to - 2 * span);
    one.to = now;
    one.character = stream.key.character;
    one.type = stream.key.type;
    one.detail = {words::Kind::RateChanged,
                  {{"rate", words::Number{rateHz}}, {"before", words::Number{usualHz}}}};
    incidents.report(one);
    stream.usualHz = rateHz;
    stream.excusedUntil = now + log::durationOf(m_thresholds.windowS); // the window has both rates
    const Occurrence limit = Occurrence::at(IncidentKind::RateLimit, stream.key.sender, now);
    if (const Incident* known = incidents.currentLike(limit)) {
        incidents.endPart(known->number, {one.sender, *one.character}, *one.type, now);
    }
    return true;
}

/// What an incident explains already is no incident of its own.
void ThresholdWatch::hold(const Stream& stream, const Measure& measure, log::Stamp stamp,
                          Incidents& incidents) const {
    Occurrence one = Occurrence::at(measure.kind, stream.key.sender, stamp);
    one.character = stream.key.character;
    one.type = stream.key.type;
    one.value = measure.value;
    one.limit = measure.limit;
    const Incident* known = incidents.currentLike(one);
    const bool isIn = known != nullptr && known->concerns(stream.key);
    const bool isAbove = measure.limit > 0 && measure.value > measure.limit;
    if (isAbove && !isIn && stamp <= stream.excusedUntil) {
        return; // an incident explains it
    }
    if (isAbove) {
        one.count = isIn ? 0 : 1;
        incidents.report(one);
    } else if (isIn && (measure.limit <= 0 || measure.value <= measure.limit * m_thresholds.hysteresis)) {
        incidents.endPart(known->number, {one.sender, *one.character}, *one.type, stamp);
    }
}

LossShare& LossShare::operator+=(const LossShare& other) {
    lost += other.lost;
    expected += other.expected;
    return *this;
}

double LossShare::ratio(double deviations) const {
    const auto count = static_cast<double>(lost);
    return expected == 0 ? 0 : (count + deviations * std::sqrt(count)) / static_cast<double>(expected);
}

std::vector<double> judgedShares(const Incident& incident,
                                 const std::function<LossShare(const Incident::Part&)>& shareOf) {
    constexpr double kClearly = -2;
    std::vector<double> shares;
    std::map<std::uint8_t, LossShare> sums;
    for (const Incident::Part& part : incident.parts) {
        const LossShare share = shareOf(part);
        shares.push_back(share.ratio(kClearly));
        sums[part.character.value_or(0)] += share;
    }
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const LossShare& all = sums[incident.parts[i].character.value_or(0)];
        shares[i] = std::max(shares[i], all.lost >= Incident::kFewSamples ? all.ratio() : 0);
    }
    return shares;
}

LossesByStream lossesInSilences(const Incidents& incidents, const std::optional<TimeRange>& range) {
    LossesByStream losses;
    for (const Incident& outage : incidents.all()) {
        const bool isMeant = !range || (outage.lastStamp >= range->from && outage.lastStamp < range->to);
        if (outage.kind != IncidentKind::Outage || !isMeant) {
            continue;
        }
        const auto cause = static_cast<std::size_t>(outage.cause.value_or(LossCause::Unknown));
        for (const Incident::Part& part : outage.parts) {
            if (part.character && part.type) {
                losses[{part.sender, *part.character, *part.type}][cause] += part.samples;
            }
        }
    }
    return losses;
}

} // namespace posewire::model
