// SPDX-License-Identifier: MIT
#include "core/model/accounting/thresholds.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace posewire::model {
namespace {

constexpr double kMost = 100'000;
constexpr double kPercent = 100;
/// What has been silent for longer is looked at again when something comes.
constexpr double kAsleepS = 10;

using T = Thresholds;

constexpr std::array kRows{
    ThresholdRow{&T::lossPercent, "lossPercent", "&Loss above", " %",
                 "Of the samples that should have come; incomplete ones included", 0, kMost, 1,
                 Figure::LossShare, EventKind::LossLimit},
    ThresholdRow{&T::jitterMs, "jitterMs", "&Jitter above", " ms", "As RFC 3550 computes it", 0, kMost, 1,
                 Figure::Jitter, EventKind::JitterLimit},
    ThresholdRow{&T::gapMs, "gapMs", "&Gap above", " ms", "Longest time between two samples", 0, kMost, 1,
                 Figure::SpacingMost, EventKind::GapLimit},
    ThresholdRow{&T::ageS, "ageS", "&Age above", " s", "Since the newest sample", 0, kMost},
    ThresholdRow{&T::ratePercent, "ratePercent", "&Rate off by more than", " %",
                 "How far the rate is from what was usual", 0, kMost},
    ThresholdRow{&T::windowS, "windowS", "&Over the last", " s",
                 "The past that loss, gap and rate are taken from", 1, 60},
    ThresholdRow{&T::hysteresis, "hysteresis", "Alert ends &below", " % of its limit",
                 "So that a figure that hovers about its limit alerts once", 1 / kPercent, 1, kPercent},
};

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

void ThresholdWatch::check(log::Stamp stamp, Events& events) {
    std::erase_if(m_awake, [&](Stream* stream) {
        check(*stream, stamp, events);
        const double ageS = log::secondsOf(stamp - stream->accounting.lastStamp());
        stream->isWatched = ageS <= std::max({kAsleepS, m_thresholds.windowS, m_thresholds.ageS});
        return !stream->isWatched;
    });
}

void ThresholdWatch::check(Stream& stream, log::Stamp stamp, Events& events) const {
    const StreamAccounting& accounting = stream.accounting;
    const log::Stamp from = stamp - log::durationOf(m_thresholds.windowS);
    const double ageS = log::secondsOf(stamp - accounting.lastStamp());
    hold(stream, {EventKind::AgeLimit, ageS, m_thresholds.ageS}, stamp, events);
    const RangeFigures read = countedFigures(accounting, TimeRange{from, stamp});
    if (read.counts.samples == 0) {
        return;
    }
    for (const ThresholdRow& row : kRows) {
        if (row.figure) {
            const double value = std::fmax(0, rowOf(*row.figure).read(read)); // 0 where it is not known
            hold(stream, {row.alert, value, m_thresholds.*row.limit}, stamp, events);
        }
    }
    const bool isWholeWindow = accounting.firstStamp() <= from && ageS < m_thresholds.windowS / 2;
    if (!isWholeWindow || m_thresholds.windowS <= 0) {
        return;
    }
    const double rateHz = static_cast<double>(read.counts.samples) / m_thresholds.windowS;
    double& usualHz = stream.usualHz;
    if (usualHz > 0) {
        const double offPercent = 100 * std::abs(rateHz - usualHz) / usualHz;
        hold(stream, {EventKind::RateLimit, offPercent, m_thresholds.ratePercent}, stamp, events);
    }
    // What lasts becomes usual: half of the way in about a minute of two checks a second.
    constexpr double kShare = 1.0 / 180;
    usualHz += usualHz > 0 ? (rateHz - usualHz) * kShare : rateHz;
}

void ThresholdWatch::hold(const Stream& stream, const Measure& measure, log::Stamp stamp,
                          Events& events) const {
    Event event = Event::of(measure.kind, stream.key.sender, stamp);
    event.character = stream.key.character;
    event.type = stream.key.type;
    event.value = measure.value;
    event.limit = measure.limit;
    const bool isKnown = events.isCurrent(event);
    if (measure.limit > 0 && measure.value > measure.limit) {
        event.count = isKnown ? 0 : 1;
        events.report(event);
    } else if (isKnown && (measure.limit <= 0 || measure.value <= measure.limit * m_thresholds.hysteresis)) {
        events.end(event, stamp);
    }
}

} // namespace posewire::model
